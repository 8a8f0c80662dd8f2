// Subsurface scattering by a normalised diffusion profile.                            [Christensen and Burley 2015]
//
//   S = A R(|x_o - x_i|) / pi
//
// normalized_diffusion.h defines R. Light enters and leaves diffusely. Where it enters is sampled by rays through the
// body (transport/wavefront/subsurface_scattering.h).
//
//   Parameters   albedo: diffuse reflectance A, multiplied by the base colour; mean-free-path: average distance between
//                scattering events below the surface; scale: multiplies the mean free path
//   Properties   Reciprocal for uniform parameters. A flat half-space has the albedo A.
//   Sampling     Radii by the profile, projected onto the surface along three axes with multiple importance sampling
//                [King et al. 2013]; directions by the cosine.
//   Limitations  Biased: the profile of a flat half-space is used for every shape. Both faces of a part thinner than the
//                mean free path count, so that it can return more light than it receives. No reflection at the
//                boundary. Only path, path-pure and distribution render it. A medium inside a boundary is the unbiased
//                alternative.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/diffusion/diffusion_profiles.h"
#include "bsdf/lobes/lambert.h"

namespace etendue {

struct SubsurfaceModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "subsurface",
      .label = "Subsurface diffusion",
      .model_class = ModelClass::phenomenological,
      .summary = "Diffuse light that leaves the surface at some distance from where it entered: skin, marble, milk.",
      .formula = "S = A R(r) / pi, R(r) = (exp(-r / d) + exp(-r / 3d)) / (8 pi d r)",
      .properties = "Reciprocal for uniform parameters. A flat half-space has the albedo A.",
      .sampling = "Radii by the profile, projected along three axes; directions by the cosine.",
      .limitations =
          "Biased: assumes a flat half-space. No reflection at the boundary. Only path, path-pure and "
          "distribution render it.",
      .source = "[Christensen and Burley 2015]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>>;

  Triple albedo{"albedo",
                "Albedo",
                Vec3(0.83f, 0.79f, 0.75f),
                {0, 1},
                "Diffuse reflectance of a flat body, multiplies the base colour"};
  Triple mean_free_path_mm{"mean-free-path",
                           "Mean free path",
                           Vec3(0.46f, 0.38f, 0.33f),
                           {0, 1e6f},
                           "Average distance between scattering events below the surface. Higher is softer and more "
                           "translucent; 0 is Lambert's model",
                           "mm",
                           Scale::logarithmic};
  Number<float> scale{"scale",
                      "Scale",
                      1,
                      {0, 1e6f},
                      "Multiplies the mean free path, for scenes that are not modelled in metres",
                      "",
                      Scale::logarithmic};
  auto parameters() { return std::tie(albedo, mean_free_path_mm, scale); }

  static std::vector<ModelPreset> presets() {
    struct Values {
      const char *name, *label, *source;
      Vec3 albedo, mean_free_path;  // mm
    };
    // The mean free path is 1 / (reduced scattering + absorption).
    static constexpr const char* kMeasured = "[Jensen et al. 2001], table 1";
    const Values materials[] = {
        {"marble", "Marble", kMeasured, {0.83f, 0.79f, 0.75f}, {0.456f, 0.381f, 0.333f}},
        {"skin", "Skin, light", kMeasured, {0.63f, 0.44f, 0.34f}, {0.907f, 0.602f, 0.517f}},
        {"skin-dark", "Skin, darker", kMeasured, {0.44f, 0.22f, 0.13f}, {1.295f, 0.952f, 0.671f}},
        {"milk", "Whole milk", kMeasured, {0.91f, 0.88f, 0.76f}, {0.392f, 0.311f, 0.264f}},
        {"skim-milk", "Skim milk", kMeasured, {0.81f, 0.81f, 0.69f}, {1.426f, 0.818f, 0.522f}},
        {"ketchup", "Ketchup", kMeasured, {0.16f, 0.01f, 0.00f}, {4.149f, 0.962f, 0.676f}},
        {"wax", "Candle wax", "chosen by eye", {0.92f, 0.86f, 0.68f}, {4.0f, 3.0f, 1.8f}}};
    std::vector<ModelPreset> presets;
    for (const Values& m : materials) {
      ModelPreset preset{m.name, m.label, m.source, {}};
      for (int k = 0; k < 3; ++k) {
        preset.values.emplace_back(std::string("albedo") + Triple::kParts[k], double{m.albedo[k]});
        preset.values.emplace_back(std::string("mean-free-path") + Triple::kParts[k], double{m.mean_free_path[k]});
      }
      presets.push_back(std::move(preset));
    }
    return presets;
  }

  Subsurface subsurface() const {
    return {.profile = profile_index<NormalizedDiffusion>(),
            .mean_free_path = rgb_of(mean_free_path_mm) * (1e-3f * scale)};
  }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Lambert<Rgb>{base * rgb_of(albedo)});
  }
};

}  // namespace etendue
