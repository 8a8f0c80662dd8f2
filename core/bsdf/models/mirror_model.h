// The ideal mirror.                                                                 thesis (4.116), item 33, E6
//
//   f = delta(wi - mirrored wo) / cos_i          reciprocal, loses nothing
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/mirror.h"

namespace etendue {

struct MirrorModel {
  static constexpr BsdfModelDescription kDescription{
      "mirror", "Mirror, ideal", ModelClass::idealised,
      "f = delta(wi - mirrored wo)/cos_i, times the base colour. Reciprocal, loses nothing where that is white.",
      "the one direction there is"};
  template <class Color>
  using Lobes = std::tuple<Mirror<Color>>;

  Number<float> reflectance{"reflectance", "Reflectance", 1, {0, 1}, "A factor on the base colour"};
  auto parameters() { return std::tie(reflectance); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Mirror<Rgb>{{}, base * reflectance, {}});
  }
};

}  // namespace etendue
