// Phong's model as a BRDF.                                                              [Lang, eq. 4.232-4.234]
//
//   f = rho_d / pi + rho_s <r, wi>^n / cos_i,       r the mirror direction of wo about the normal
//
//   Parameters   diffuse: rho_d as a factor of the base colour; specular: rho_s in 1/sr; exponent: n
//   Properties   Not reciprocal: only one of the two cosines is divided out. Does not conserve energy: the albedo
//                grows without bound towards grazing incidence (39 at 89 degrees for rho_s = 1, n = 1).
//   Sampling     cos^n about the mirror direction; samples below the surface are absorbed.
//   Limitations  The specular albedo at normal incidence is 2 pi rho_s / (n + 2). It tends to 0 for large n, not to a
//                mirror as stated in [Lang, sec. 4.2.2.5.2].
#pragma once
#include "bsdf/lobes/cosine_power.h"

namespace etendue {

struct PhongModel : PhongParameters {
  static constexpr BsdfModelDescription kDescription{
      .name = "phong",
      .label = "Phong (BRDF)",
      .model_class = ModelClass::phenomenological,
      .summary =
          "Phong's illumination model as a BRDF: a diffuse term and a power of the cosine to the mirror direction.",
      .formula = "f = rho_d / pi + rho_s <r, wi>^n / cos_i",
      .properties = "Neither reciprocal nor energy conserving.",
      .sampling = "cos^n about the mirror direction; samples below the surface are absorbed.",
      .limitations = "The albedo exceeds any bound at grazing incidence, and tends to 0 for large exponents.",
      .source = "[Phong 1975], [Lang, eq. 4.232-4.234]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  PhongModel() : PhongParameters("Height of the highlight, 1/sr") {}

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    PhongParameters::add_lobes(base, 1, true, lobes);
  }
};

}  // namespace etendue
