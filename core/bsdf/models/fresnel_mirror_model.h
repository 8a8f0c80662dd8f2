// A polished surface: the ideal mirror with Fresnel's reflectance.         thesis (4.83)-(4.90), (4.123), item 34, E3
//
//   f = F(cos_i) delta(wi - mirrored wo) / cos_i          reciprocal, albedo F(cos_i)
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/mirror.h"

namespace etendue {

struct FresnelMirrorModel {
  static constexpr BsdfModelDescription kDescription{
      "fresnel-mirror", "Mirror, Fresnel", ModelClass::idealised,
      "f = F(cos_i) delta(wi - mirrored wo)/cos_i: polished metal, or the reflection of a polished dielectric whose "
      "inside is black. Reciprocal; its albedo is F.",
      "the one direction there is"};
  template <class Color>
  using Lobes = std::tuple<Mirror<Color>>;

  FresnelParameters fresnel;
  auto parameters() { return fresnel.parameters(); }
  static std::vector<ModelPreset> presets() { return fresnel_presets(); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Mirror<Rgb>{{}, base, fresnel.term()});
  }
};

}  // namespace etendue
