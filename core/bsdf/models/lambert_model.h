// Lambert's model of diffuse reflection: the same radiance in all directions.        [Lang, eq. 4.217-4.219]
//
//   f = rho / pi
//
//   Parameters   diffuse: a factor of the base colour; rho is their product
//   Properties   Reciprocal. Conserves energy for rho <= 1; the albedo is rho.
//   Sampling     By the cosine, the exact shape of f cos_i; every sample has the weight rho.
//   Limitations  An idealisation: no real surface reflects the same radiance in all directions.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"

namespace etendue {

struct LambertModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "lambert",
      .label = "Lambert",
      .model_class = ModelClass::idealised,
      .summary = "Ideal diffuse reflection: the same radiance in all directions.",
      .formula = "f = rho / pi",
      .properties = "Reciprocal. Conserves energy for rho <= 1.",
      .sampling = "By the cosine, the exact shape of f cos_i.",
      .limitations = "An idealisation: no real surface reflects the same radiance in all directions.",
      .source = "[Lang, eq. 4.217-4.219]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 1, {0, 1}, "Diffuse reflectance, multiplies the base colour"};
  auto parameters() { return std::tie(diffuse); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
  }
};

}  // namespace etendue
