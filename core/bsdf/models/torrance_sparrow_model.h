// The Torrance-Sparrow model in its present form: mirror microfacets with Smith masking.
//                             [Torrance and Sparrow 1967; Walter et al. 2007; Heitz 2014, 2018; Kulla and Conty 2017]
//   f = rho_d / pi + rho_s F(<o, h>) D(h) G2(o, i) / (4 cos_o cos_i) [+ f_ms]
//
// f_ms restores the light that microfacets scatter more than once (energy_compensation.h).
//
//   Parameters   diffuse: rho_d as a factor of the base colour; specular: rho_s; distribution: GGX or Beckmann;
//                alpha-x, alpha-y: roughness along two axes, both 0 is a mirror; rotation: of the axes,
//                counter-clockwise from the tangent; multiple-scattering: f_ms; fresnel, eta, kappa: the Fresnel term
//   Properties   Reciprocal. Conserves energy for rho_d + rho_s <= 1, to 1 % with f_ms.
//   Sampling     Visible normals; the weight is rho_s F G2 / G1. Samples below the surface are absorbed. f_ms by the
//                cosine.
//   Limitations  Without f_ms and with F = 1 the albedo at normal incidence is 0.877, 0.687, 0.307 for GGX with alpha
//                = 0.3, 0.5, 1, and 1.000, 0.943, 0.461 for Beckmann.
#pragma once
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/mirror.h"
#include "bsdf/microfacet/energy_compensation.h"

namespace etendue {

struct TorranceSparrowModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "torrance-sparrow",
      .label = "Torrance-Sparrow (GGX, Beckmann)",
      .model_class = ModelClass::physical,
      .summary =
          "Mirror microfacets with Smith masking, isotropic or anisotropic, with energy compensation for multiple "
          "scattering, over a diffuse term.",
      .formula = "f = rho_d / pi + rho_s F(<o, h>) D(h) G2(o, i) / (4 cos_o cos_i) + f_ms",
      .properties = "Reciprocal. Conserves energy for rho_d + rho_s <= 1, to 1 %.",
      .sampling =
          "Visible normals, weight rho_s F G2 / G1; samples below the surface are absorbed. Multiple scattering by "
          "the cosine.",
      .limitations = "Without energy compensation, rough surfaces lose up to 70 % of the light.",
      .source = "[Torrance and Sparrow 1967], [Walter et al. 2007], [Heitz 2014], [Heitz 2018], [Kulla and Conty 2017]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, Mirror<Color>, MicrofacetReflection<Color, Ggx>,
                           MicrofacetReflection<Color, Beckmann>, EnergyCompensation<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0, {0, 1}, "Diffuse reflectance, multiplies the base colour"};
  Triple specular{"specular", "Specular", Vec3(1), {0, 1}, "Factor of the light that the microfacets reflect"};
  Choice<MicrofacetDistribution> distribution{"distribution", "Distribution", MicrofacetDistribution::ggx,
                                              "Distribution of the microfacet normals; GGX has longer tails"};
  Number<float> alpha_x{"alpha-x", "Roughness \u03b1_x", 0.3f, {0, 1}, "Roughness along the tangent; 0 is a mirror"};
  Number<float> alpha_y{"alpha-y", "Roughness \u03b1_y", 0.3f, {0, 1}, "Roughness across the tangent; 0 is a mirror"};
  Number<float> rotation{
      "rotation", "Rotation", 0, {-180, 180}, "Rotates the axes of the roughness, counter-clockwise from the tangent",
      "deg"};
  Toggle multiple{"multiple-scattering", "Multiple scattering", true,
                  "Restore the energy of light that microfacets scatter more than once"};
  FresnelParameters fresnel;
  auto parameters() {
    return std::tuple_cat(std::tie(diffuse, specular, distribution, alpha_x, alpha_y, rotation, multiple),
                          fresnel.parameters());
  }
  static std::vector<ModelPreset> presets() { return fresnel_presets(); }

  const MicrofacetEnergy* energy = nullptr;  // of f_ms, else null; valid until the program ends
  void prepare() {
    const bool smooth = alpha_x < kSmoothAlpha && alpha_y < kSmoothAlpha;
    energy =
        multiple && !smooth ? &MicrofacetEnergy::of(distribution, resolvable(alpha_x), resolvable(alpha_y)) : nullptr;
  }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    if (diffuse > 0) lobes.add(Lambert<Rgb>{base * diffuse});
    if (alpha_x < kSmoothAlpha && alpha_y < kSmoothAlpha)
      lobes.add(Mirror<Rgb>{{}, rgb_of(specular), fresnel.term()});
    else if (distribution == MicrofacetDistribution::ggx)
      add_facets<Ggx>(lobes);
    else
      add_facets<Beckmann>(lobes);
  }

 private:
  static float resolvable(float alpha) { return std::max(alpha, kMinAlpha); }

  template <class Facets, class LobeSet>
  void add_facets(LobeSet& lobes) const {
    MicrofacetReflection<Rgb, Facets> lobe;
    lobe.tint = rgb_of(specular);
    lobe.fresnel = fresnel.term();
    lobe.facets.alpha_x = resolvable(alpha_x);
    lobe.facets.alpha_y = resolvable(alpha_y);
    const float angle = rotation * (kPi / 180);
    lobe.facets.along = Vec2(std::cos(angle), std::sin(angle));
    lobes.add(lobe);
    if (energy) lobes.add(EnergyCompensation<Rgb>::of(*energy, lobe.facets.along, lobe.tint, lobe.fresnel));
  }
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::MicrofacetDistribution> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"ggx", "GGX"}, {"beckmann", "Beckmann"}}};
};
