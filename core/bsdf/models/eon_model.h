// Oren and Nayar's model with its energy kept.                              Portsmouth, Kutz and Hill 2025
//
// The formulas are in material/eon.h. Reciprocal; its albedo is one for rho = 1, whatever the roughness and the angle.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/eon.h"

namespace etendue {

struct EonModel {
  static constexpr BsdfModelDescription kDescription{
      "eon", "Oren-Nayar, energy-preserving (EON)", ModelClass::physical,
      "Fujii's form of Oren and Nayar's model and a lobe for the light that is scattered again (Portsmouth, Kutz, Hill "
      "2025). Reciprocal; gives back all light for rho = 1.",
      "by the paper's clipped linearly transformed cosine, mixed with uniform directions"};
  template <class Color>
  using Lobes = std::tuple<Eon<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 1, {0, 1}, "Reflectance rho, as a factor on the base colour"};
  Number<float> roughness{"roughness", "Roughness", 0.5f, {0, 1}, "0 is Lambert's model, 1 the steepest grooves"};
  auto parameters() { return std::tie(diffuse, roughness); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    Eon<Rgb> lobe;
    lobe.albedo = base * diffuse, lobe.roughness = roughness;
    lobes.add(lobe);
  }
};

}  // namespace etendue
