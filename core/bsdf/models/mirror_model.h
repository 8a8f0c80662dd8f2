// The ideal mirror.                                                              [Lang, eq. 4.91-4.94, corrected]
//
//   f = rho delta(wi - r) / cos_i,       r the mirror direction of wo about the shading normal
//
//   Parameters   reflectance: a factor of the base colour; rho is their product
//   Properties   Reciprocal. Conserves energy; the albedo is rho.
//   Sampling     The mirror direction; the weight is rho.
//   Limitations  No Fresnel term; fresnel_mirror_model.h has one.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/mirror.h"

namespace etendue {

struct MirrorModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "mirror",
      .label = "Mirror, ideal",
      .model_class = ModelClass::idealised,
      .summary = "A perfect mirror that reflects the base colour. Lossless for a white base colour.",
      .formula = "f = rho delta(wi - r) / cos_i",
      .properties = "Reciprocal. Conserves energy; the albedo is rho.",
      .sampling = "The mirror direction.",
      .limitations = "The reflectance does not depend on the angle.",
      .source = "[Lang, eq. 4.91-4.94, corrected]",
  };
  template <class Color>
  using Lobes = std::tuple<Mirror<Color>>;

  Number<float> reflectance{
      "reflectance", "Reflectance", 1, {0, 1}, "Reflected part of the light; multiplies the base colour"};
  auto parameters() { return std::tie(reflectance); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Mirror<Rgb>{{}, base * reflectance, {}});
  }
};

}  // namespace etendue
