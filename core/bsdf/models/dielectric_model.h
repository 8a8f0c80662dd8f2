// The boundary of a clear solid, polished or rough.                  thesis (4.124)-(4.137), items 37-39, 68, E8, E10
//
// The formulas are in material/dielectric.h. Reciprocal up to the eta^2 law: f(i -> o) / eta_o^2 = f(o -> i) / eta_i^2.
// A polished boundary loses nothing; a rough one what its facets scatter more than once.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/dielectric.h"

namespace etendue {

struct DielectricModel {
  static constexpr BsdfModelDescription kDescription{
      "dielectric", "Dielectric (glass, water)", ModelClass::physical,
      "Reflection and refraction with exact Fresnel terms; GGX facets where it is rough (Walter et al. 2007). "
      "Reciprocal up to the eta^2 law; polished it loses nothing.",
      "polished: reflection or refraction by F; rough: visible normals, then by F"};
  static constexpr bool kSolid = true;
  template <class Color>
  using Lobes = std::tuple<Dielectric<Color>>;

  Number<float> eta{"eta", "Index", 1.5f, {0.3f, 4}, "Index of refraction inside over outside; 1 is no boundary"};
  Number<float> roughness{"roughness", "Roughness", 0, {0, 1}, "Slope of the facets (alpha); 0 is polished"};
  auto parameters() { return std::tie(eta, roughness); }
  static std::vector<ModelPreset> presets() { return dielectric_presets(); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    Dielectric<Rgb> lobe;
    lobe.tint = base, lobe.eta = eta;
    lobe.facets.alpha_x = lobe.facets.alpha_y = roughness;
    lobes.add(lobe);
  }
};

}  // namespace etendue
