// Cook and Torrance's model.                            thesis (4.259)-(4.294), items 59-63, E19-E22, stability 7
//
//   f = rho_d / pi + rho_s F(<i, h>) G D(h) / (4 cos_i cos_o),    D = sum W_k D_k,  sum W_k = 1
//
// Reciprocal. With V-groove masking its albedo never exceeds rho_d + rho_s; it loses what is scattered between facets
// again: F = 1 at normal incidence keeps 0.996, 0.892, 0.454 of the light for m = 0.3, 0.5, 1 (Beckmann). Without G it
// gains it at grazing angles: 8.59 at 89 degrees for m = 0.5. Facets without slope are a mirror.
#pragma once
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/mirror.h"
#include "bsdf/lobes/vgroove_microfacet.h"

namespace etendue {

struct CookTorranceModel {
  static constexpr BsdfModelDescription kDescription{
      "cook-torrance", "Cook-Torrance", ModelClass::physical,
      "f = rho_d/pi + rho_s F G D/(4 cos_i cos_o) with the masking of V-shaped grooves and up to three scales of "
      "roughness. Reciprocal; loses energy with roughness, and gains it if G is left out.",
      "normals by D (for the Gaussian by theta exp(-theta^2/m^2)); weight F G <o,h>/(cos_h cos_o), not bounded at "
      "grazing angles; what leaves below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, Mirror<Color>, VGrooveMicrofacet<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.2f, {0, 1}, "rho_d, as a factor on the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.8f), {0, 1}, "rho_s: a factor on what the facets reflect"};
  Choice<SlopeKind> distribution{"distribution", "Distribution", SlopeKind::beckmann, "Of the facets' normals"};
  Number<float> m{"m", "Slope", 0.3f, {0, 1}, "m: root mean square slope of the facets; 0 is a mirror"};
  Number<float> m2{"m-2", "Second slope", 0.1f, {0, 1}, "m of a second scale of roughness"};
  Number<float> weight2{"weight-2", "Second weight", 0, {0, 1}, "W of the second scale, before the sum is made one"};
  Number<float> m3{"m-3", "Third slope", 0.6f, {0, 1}, "m of a third scale of roughness"};
  Number<float> weight3{"weight-3", "Third weight", 0, {0, 1}, "W of the third scale, where the first has 1"};
  Toggle masked{"masking", "Masking and shadowing", true, "G; without it energy is gained at grazing angles"};
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
    grooves.tint = rgb_of(specular), grooves.fresnel = fresnel.term(), grooves.masked = masked;
    float smooth = 0;
    const float total = 1 + weight2 + weight3;
    for (const auto& [slope, weight] : {std::pair<float, float>{m, 1.0f}, {m2, weight2}, {m3, weight3}}) {
      if (weight == 0) continue;
      if (slope < kSmoothAlpha)
        smooth += weight / total;
      else
        grooves.add(SlopeDistribution::of(distribution, slope, weight / total));
    }
    if (grooves.count > 0) lobes.add(grooves);
    if (smooth > 0) lobes.add(Mirror<Rgb>{{}, grooves.tint * smooth, grooves.fresnel});
  }
};

}  // namespace etendue
