// The modified Phong model, normalised and reciprocal.              [Lafortune and Willems 1994; Lang, eq. 4.248-4.249]
//
//   f = rho_d / pi + rho_s (n + 2) / (2 pi) <r, wi>^n,       r the mirror direction of wo about the normal
//
//   Parameters   diffuse: rho_d as a factor of the base colour; specular: rho_s, the specular albedo at normal
//                incidence; exponent: n
//   Properties   Reciprocal. Conserves energy for rho_d + rho_s <= 1.
//   Sampling     cos^n about the mirror direction; samples below the surface are absorbed.
//   Limitations  The albedo is largest at normal incidence and falls with the angle, to rho_d + rho_s cos_i for large
//                n.
#pragma once
#include "bsdf/lobes/cosine_power.h"

namespace etendue {

struct ModifiedPhongModel : PhongParameters {
  static constexpr BsdfModelDescription kDescription{
      .name = "modified-phong",
      .label = "Phong, modified (Lafortune and Willems)",
      .model_class = ModelClass::phenomenological,
      .summary = "The physically plausible form of Phong's BRDF: reciprocal, with a normalised lobe.",
      .formula = "f = rho_d / pi + rho_s (n + 2) / (2 pi) <r, wi>^n",
      .properties = "Reciprocal. Conserves energy for rho_d + rho_s <= 1.",
      .sampling = "cos^n about the mirror direction; samples below the surface are absorbed.",
      .limitations = "The albedo falls towards grazing angles.",
      .source = "[Lafortune and Willems 1994], [Lang, eq. 4.248-4.249]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  ModifiedPhongModel() : PhongParameters("Specular albedo at normal incidence") {}

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    PhongParameters::add_lobes(base, (exponent + 2) / (2 * kPi), false, lobes);
  }
};

}  // namespace etendue
