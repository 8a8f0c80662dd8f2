// Torrance and Sparrow's facets as they are used today.      Torrance, Sparrow 1967; Heitz 2014; thesis item 66 (by
// name)
//
// The formulas are in material/facet_reflection.h and facet_energy.h. Reciprocal. Without the light that is scattered
// again, F = 1 keeps at normal incidence 0.877, 0.687, 0.307 of all light for GGX with alpha = 0.3, 0.5, 1, and 1.000,
// 0.943, 0.461 for Beckmann; with it, all to 1 %.
#pragma once
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/mirror.h"
#include "bsdf/microfacet/energy_compensation.h"

namespace etendue {

struct TorranceSparrowModel {
  static constexpr BsdfModelDescription kDescription{
      "torrance-sparrow", "Torrance-Sparrow (GGX, Beckmann)", ModelClass::physical,
      "f = rho_d/pi + rho_s F D G2/(4 cos_o cos_i) with Smith's height-correlated masking, and a lobe for light that "
      "is "
      "scattered between facets again (Kulla and Conty 2017). Reciprocal.",
      "normals that the viewer sees, F G2/G1 is the weight; what leaves below the surface is absorbed. The lobe of "
      "multiple scattering falls back to the cosine"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, Mirror<Color>, MicrofacetReflection<Color, Ggx>,
                           MicrofacetReflection<Color, Beckmann>, EnergyCompensation<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0, {0, 1}, "rho_d, as a factor on the base colour"};
  Triple specular{"specular", "Specular", Vec3(1), {0, 1}, "rho_s: a factor on what the facets reflect"};
  Choice<MicrofacetDistribution> distribution{"distribution", "Facets", MicrofacetDistribution::ggx,
                                              "GGX has longer tails than Beckmann"};
  Number<float> alpha_x{"alpha-x", "Slope along", 0.3f, {0, 1}, "alpha of the facets along the tangent; 0 is a mirror"};
  Number<float> alpha_y{"alpha-y", "Slope across", 0.3f, {0, 1}, "alpha of the facets across the tangent"};
  Number<float> rotation{"rotation", "Rotation", 0, {-180, 180}, "Of the two axes, counter-clockwise from the tangent",
                         "deg"};
  Toggle multiple{"multiple-scattering", "Multiple scattering", true,
                  "Give back what is scattered between facets again"};
  FresnelParameters fresnel;
  auto parameters() {
    return std::tuple_cat(std::tie(diffuse, specular, distribution, alpha_x, alpha_y, rotation, multiple),
                          fresnel.parameters());
  }
  static std::vector<ModelPreset> presets() { return fresnel_presets(); }

  const MicrofacetEnergy* energy = nullptr;  // where multiple scattering is given back; kept for good
  void prepare() {
    const bool smooth = alpha_x < kSmoothAlpha && alpha_y < kSmoothAlpha;
    energy = multiple && !smooth ? &MicrofacetEnergy::of(distribution, groove(alpha_x), groove(alpha_y)) : nullptr;
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
  static float groove(float alpha) { return std::max(alpha, kMinAlpha); }

  template <class Facets, class LobeSet>
  void add_facets(LobeSet& lobes) const {
    MicrofacetReflection<Rgb, Facets> lobe;
    lobe.tint = rgb_of(specular), lobe.fresnel = fresnel.term();
    lobe.facets.alpha_x = groove(alpha_x), lobe.facets.alpha_y = groove(alpha_y);
    const float turn = rotation * (kPi / 180);
    lobe.facets.along = Vec2(std::cos(turn), std::sin(turn));
    lobes.add(lobe);
    if (energy) lobes.add(EnergyCompensation<Rgb>::of(*energy, lobe.facets.along, lobe.tint, lobe.fresnel));
  }
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::MicrofacetDistribution> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"ggx", "GGX"}, {"beckmann", "Beckmann"}}};
};
