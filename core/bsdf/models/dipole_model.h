// Subsurface scattering by the dipole diffusion approximation, below a smooth dielectric boundary.
//                                                                                          [Jensen et al. 2001]
//
//   S = T(cos_o) R(|x_o - x_i|) T(cos_i) / (pi (1 - F))
//
// dipole_diffusion.h defines R, fresnel_diffuse.h T and F. Jensen et al. omit 1 - F: the boundary condition of R
// includes the internal reflection already, so that their form loses the share F of the light. Where light enters is
// sampled by rays through the body (transport/wavefront/subsurface_scattering.h). The boundary reflects as a mirror.
//
//   Parameters   albedo: the share A of the entered light that leaves again, multiplied by the base colour;
//                mean-free-path: 1 / (reduced scattering + absorption); eta: index of refraction of the body relative
//                to its surroundings; scale: multiplies the mean free path
//   Properties   Reciprocal for uniform parameters. A flat half-space reflects A T(cos_o) diffusely and 1 - T(cos_o)
//                as a mirror, hence all light for A = 1.
//   Sampling     Reflection or entry in proportion to their albedos; radii by the profile, projected onto the surface
//                along three axes with multiple importance sampling [King et al. 2013]; directions by the cosine.
//   Limitations  Biased: a flat half-space is assumed for every shape, and light is assumed to be diffuse within one
//                mean free path, which fails for A below about 0.5. Single scattering is not separated. Only path,
//                path-pure and distribution render it. A medium inside a dielectric boundary is the unbiased
//                alternative.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/diffusion/diffusion_profiles.h"
#include "bsdf/lobes/fresnel_diffuse.h"
#include "bsdf/lobes/mirror.h"

namespace etendue {

struct DipoleModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "dipole",
      .label = "Subsurface dipole",
      .model_class = ModelClass::physical,
      .summary =
          "Subsurface scattering by the dipole approximation of diffusion, with reflection and refraction at a smooth "
          "boundary: polished marble, milk, wax.",
      .formula =
          "S = T(cos_o) R(r) T(cos_i) / (pi (1 - F))\n"
          "R = alpha / (4 pi) sum z (sigma + 1 / d) exp(-sigma d) / d^2, d^2 = r^2 + z^2",
      .properties = "Reciprocal for uniform parameters. A flat half-space with A = 1 reflects all light.",
      .sampling = "Reflection or entry by albedo; radii by the profile, projected along three axes.",
      .limitations =
          "Biased: assumes a flat half-space and diffuse light inside. Too bright close to the entry for albedos below "
          "0.5. Only path, path-pure and distribution render it.",
      .source = "[Jensen et al. 2001]",
  };
  template <class Color>
  using Lobes = std::tuple<Mirror<Color>, FresnelDiffuse<Color>>;

  Triple albedo{"albedo",
                "Albedo",
                Vec3(0.83f, 0.79f, 0.75f),
                {0, 1},
                "Share of the entered light that a flat body returns, multiplies the base colour"};
  Triple mean_free_path_mm{"mean-free-path",
                           "Mean free path",
                           Vec3(0.46f, 0.38f, 0.33f),
                           {0, 1e6f},
                           "1 / (reduced scattering + absorption). Higher is softer and more translucent",
                           "mm",
                           Scale::logarithmic};
  Number<float> eta{"eta",
                    "IOR \u03b7",
                    1.3f,
                    {1, 3},
                    "Index of refraction of the body relative to its surroundings. Higher reflects more at the surface "
                    "and widens the profile; 1 removes the boundary"};
  Number<float> scale{"scale",
                      "Scale",
                      1,
                      {0, 1e6f},
                      "Multiplies the mean free path, for scenes that are not modelled in metres",
                      "",
                      Scale::logarithmic};
  auto parameters() { return std::tie(albedo, mean_free_path_mm, eta, scale); }

  // The measured media of the paper, also presets of media: the same coefficients for the random walk.
  static std::vector<ModelPreset> presets() {
    struct Coefficients {
      const char *name, *label;
      Rgb scattering, absorption;  // reduced, 1/mm
      float eta = 1.3f;
    };
    const Coefficients materials[] = {{"marble", "Marble", {2.19f, 2.62f, 3.00f}, {0.0021f, 0.0041f, 0.0071f}, 1.5f},
                                      {"skin-1", "Skin 1", {0.74f, 0.88f, 1.01f}, {0.032f, 0.17f, 0.48f}},
                                      {"skin-2", "Skin 2", {1.09f, 1.59f, 1.79f}, {0.013f, 0.070f, 0.145f}},
                                      {"milk", "Whole milk", {2.55f, 3.21f, 3.77f}, {0.0011f, 0.0024f, 0.014f}},
                                      {"skim-milk", "Skim milk", {0.70f, 1.22f, 1.90f}, {0.0014f, 0.0025f, 0.0142f}},
                                      {"cream", "Cream", {7.38f, 5.47f, 3.15f}, {0.0002f, 0.0028f, 0.0163f}},
                                      {"ketchup", "Ketchup", {0.18f, 0.07f, 0.03f}, {0.061f, 0.97f, 1.45f}},
                                      {"spectralon", "Spectralon", {11.6f, 20.4f, 14.9f}, Rgb(0)}};
    std::vector<ModelPreset> presets;
    for (const Coefficients& m : materials)
      presets.push_back(preset(m.name, m.label, m.scattering, m.absorption, m.eta));
    return presets;
  }

  void prepare() { mean_transmitted = 1 - diffuse_fresnel_outside(eta); }

  Subsurface subsurface() const {
    const float transmitted_at_normal = 1 - f0_from_ior(eta);
    return {.profile = profile_index<DipoleDiffusion>(),
            .mean_free_path = rgb_of(mean_free_path_mm) * (1e-3f * scale),
            .mismatch = boundary_mismatch(eta),
            .albedo_scale = kPi * (1 - diffuse_fresnel_outside(eta)) / sqr(transmitted_at_normal)};
  }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    if (eta != 1) lobes.add(Mirror<Rgb>{{}, Rgb(1), {FresnelKind::dielectric, Rgb(eta), Rgb(0)}});
    lobes.add(FresnelDiffuse<Rgb>{{}, base * rgb_of(albedo), eta, mean_transmitted});
  }

 private:
  float mean_transmitted = 1;  // 1 - F, set by `prepare`

  static ModelPreset preset(const char* name, const char* label, const Rgb& scattering, const Rgb& absorption,
                            float eta) {
    ModelPreset preset{name, label, "[Jensen et al. 2001], table 1, by albedo inversion", {}};
    const float mismatch = boundary_mismatch(eta);
    for (int k = 0; k < 3; ++k) {
      const float extinction = scattering[k] + absorption[k];
      const float albedo = DipoleDiffusion::albedo_of(scattering[k], absorption[k], mismatch);
      preset.values.emplace_back(std::string("albedo") + Triple::kParts[k], double{albedo});
      preset.values.emplace_back(std::string("mean-free-path") + Triple::kParts[k], double{1 / extinction});
    }
    preset.values.emplace_back("eta", double{eta});
    return preset;
  }
};

}  // namespace etendue
