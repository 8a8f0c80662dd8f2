// The reciprocal form of Phong's BRDF, without the division by the cosine.                   [Lang, eq. 4.238]
//
//   f = rho_d / pi + rho_s <r, wi>^n,       r the mirror direction of wo about the normal
//
//   Parameters   diffuse: rho_d as a factor of the base colour; specular: rho_s in 1/sr; exponent: n
//   Properties   Reciprocal. Not normalised: conserves energy only if rho_d + 2 pi rho_s / (n + 2) <= 1 (2.09 for
//                rho_s = n = 1).
//   Sampling     cos^n about the mirror direction; samples below the surface are absorbed.
//   Limitations  Darkens towards grazing angles.
#pragma once
#include "bsdf/lobes/cosine_power.h"

namespace etendue {

struct ReciprocalPhongModel : PhongParameters {
  static constexpr BsdfModelDescription kDescription{
      .name = "reciprocal-phong",
      .label = "Phong, reciprocal",
      .model_class = ModelClass::phenomenological,
      .summary = "Phong's BRDF without the division by the cosine, which makes it reciprocal.",
      .formula = "f = rho_d / pi + rho_s <r, wi>^n",
      .properties = "Reciprocal. Conserves energy only if rho_d + 2 pi rho_s / (n + 2) <= 1.",
      .sampling = "cos^n about the mirror direction; samples below the surface are absorbed.",
      .limitations = "The specular lobe is not normalised; the albedo falls towards grazing angles.",
      .source = "[Lang, eq. 4.238]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  ReciprocalPhongModel() : PhongParameters("Height of the highlight, 1/sr") {}

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    PhongParameters::add_lobes(base, 1, false, lobes);
  }
};

}  // namespace etendue
