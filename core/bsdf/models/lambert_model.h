// Lambert's model: the same radiance to everywhere.                              thesis (4.146), (4.202), item 49
//
//   f = rho / pi
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"

namespace etendue {

struct LambertModel {
  static constexpr BsdfModelDescription kDescription{
      "lambert", "Lambert", ModelClass::idealised,
      "f = rho/pi: the same radiance to all directions. Reciprocal, conserves energy for rho up to 1.",
      "by the cosine, which is its own lobe exactly"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 1, {0, 1}, "Reflectance rho, as a factor on the base colour"};
  auto parameters() { return std::tie(diffuse); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
  }
};

}  // namespace etendue
