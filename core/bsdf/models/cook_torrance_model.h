// The Cook-Torrance model: mirror microfacets in V-shaped grooves.
//                                                       [Cook and Torrance 1982; Lang, eq. 4.260-4.292, corrected]
//   f = rho_d / pi + rho_s F(<i, h>) G D(h) / (4 cos_i cos_o),       D = sum W_k D_k,  sum W_k = 1
//
//   Parameters   diffuse: rho_d as a factor of the base colour; specular: rho_s; distribution: Beckmann or Gaussian
//                (slope_distribution.h); m, m-2, m-3: root mean square slopes of up to three scales of roughness, 0
//                is a mirror; weight-2, weight-3: W relative to the weight 1 of the first, then normalised to the sum
//                1; masking: G of the V-grooves (vgroove_microfacet.h); fresnel, eta, kappa: the Fresnel term
//   Properties   Reciprocal. With G the albedo never exceeds rho_d + rho_s. Without G it grows at grazing angles:
//                8.59 at 89 degrees for m = 0.5.
//   Sampling     Normals by D, by theta exp(-theta^2 / m^2) for the Gaussian. The weight F G <o, h> / (cos_h cos_o)
//                is not bounded at grazing angles. Samples below the surface are absorbed.
//   Limitations  Light that is scattered more than once is lost. With F = 1 the albedo at normal incidence is 0.996,
//                0.892, 0.454 for m = 0.3, 0.5, 1 (Beckmann).
#pragma once
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/mirror.h"
#include "bsdf/lobes/vgroove_microfacet.h"

namespace etendue {

struct CookTorranceModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "cook-torrance",
      .label = "Cook-Torrance",
      .model_class = ModelClass::physical,
      .summary = "Mirror microfacets in V-shaped grooves with up to three scales of roughness, over a diffuse term.",
      .formula =
          "f = rho_d / pi + rho_s F(<i, h>) G D(h) / (4 cos_i cos_o),  D = sum W_k D_k\n"
          "G = min(1, 2 cos_h cos_o / <o, h>, 2 cos_h cos_i / <o, h>)",
      .properties = "Reciprocal. Conserves energy for rho_d + rho_s <= 1; gains energy if G is left out.",
      .sampling =
          "Normals by D; the weights are not bounded at grazing angles. Samples below the surface are absorbed.",
      .limitations = "Loses the light that microfacets scatter more than once.",
      .source = "[Cook and Torrance 1982], [Lang, eq. 4.260-4.292, corrected]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, Mirror<Color>, VGrooveMicrofacet<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.2f, {0, 1}, "Diffuse reflectance, multiplies the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.8f), {0, 1}, "Factor of the light that the microfacets reflect"};
  Choice<SlopeKind> distribution{"distribution", "Distribution", SlopeKind::beckmann,
                                 "Distribution of the microfacet normals"};
  Number<float> m{
      "m", "Roughness m", 0.3f, {0, 1}, "Root mean square slope of the microfacets; higher is rougher, 0 is a mirror"};
  Number<float> m2{"m-2", "Second roughness", 0.1f, {0, 1}, "m of the second scale of roughness"};
  Number<float> weight2{"weight-2", "Second weight", 0, {0, 1}, "Weight of the second scale; the first has 1"};
  Number<float> m3{"m-3", "Third roughness", 0.6f, {0, 1}, "m of the third scale of roughness"};
  Number<float> weight3{"weight-3", "Third weight", 0, {0, 1}, "Weight of the third scale; the first has 1"};
  Toggle masked{"masking", "Masking and shadowing", true,
                "Microfacets block each other; off gains energy at grazing angles"};
  FresnelParameters fresnel;
  auto parameters() {
    return std::tuple_cat(std::tie(diffuse, specular, distribution, m, m2, weight2, m3, weight3, masked),
                          fresnel.parameters());
  }
  static std::vector<ModelPreset> presets() { return fresnel_presets(); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    if (diffuse > 0) lobes.add(Lambert<Rgb>{base * diffuse});
    VGrooveMicrofacet<Rgb> grooves;
    grooves.tint = rgb_of(specular);
    grooves.fresnel = fresnel.term();
    grooves.masked = masked;
    float mirror_weight = 0;
    const float total = 1 + weight2 + weight3;
    for (const auto& [roughness, weight] : {std::pair<float, float>{m, 1.0f}, {m2, weight2}, {m3, weight3}}) {
      if (weight == 0) continue;
      if (roughness < kSmoothAlpha)
        mirror_weight += weight / total;
      else
        grooves.add(SlopeDistribution::of(distribution, roughness, weight / total));
    }
    if (grooves.count > 0) lobes.add(grooves);
    if (mirror_weight > 0) lobes.add(Mirror<Rgb>{{}, grooves.tint * mirror_weight, grooves.fresnel});
  }
};

}  // namespace etendue
