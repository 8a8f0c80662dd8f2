// The qualitative Oren-Nayar model of rough clay and sand: Lambertian V-grooves.                 [Oren and Nayar 1994]
//
//   f = rho / pi (A + B max(0, cos dphi) sin a tan b),   a = max(theta_o, theta_i), b = min(theta_o, theta_i)
//   A = 1 - s^2 / (2 (s^2 + 0.33)),  B = 0.45 s^2 / (s^2 + 0.09)
//
//   Parameters   diffuse: a factor of the base colour, rho is their product; sigma: s, the standard deviation of the
//                slope angle in radians, 0 is Lambert's model
//   Properties   Reciprocal. The albedo exceeds rho by up to 1.4 % at grazing angles (1.0140 at 89 degrees for 10
//                degrees), and is below rho at all angles for large s.
//   Sampling     By the cosine.
//   Limitations  The qualitative form approximates interreflection without an energy balance; eon_model.h keeps it.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/oren_nayar.h"

namespace etendue {

struct OrenNayarModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "oren-nayar",
      .label = "Oren-Nayar (qualitative)",
      .model_class = ModelClass::physical,
      .summary = "Rough diffuse surfaces such as clay: Lambertian V-grooves. Flatter shading than Lambert's model.",
      .formula =
          "f = rho / pi (A + B max(0, cos dphi) sin a tan b),  a = max(theta_o, theta_i), b = min(theta_o, theta_i)\n"
          "A = 1 - s^2 / (2 (s^2 + 0.33)),  B = 0.45 s^2 / (s^2 + 0.09)",
      .properties = "Reciprocal. The albedo exceeds rho by up to 1.4 % at grazing angles.",
      .sampling = "By the cosine.",
      .limitations = "Approximates interreflection without an energy balance; EON keeps it.",
      .source = "[Oren and Nayar 1994]",
  };
  template <class Color>
  using Lobes = std::tuple<OrenNayar<Color>>;

  Number<float> diffuse{
      "diffuse", "Diffuse", 1, {0, 1}, "Diffuse reflectance of the grooves, multiplies the base colour"};
  Number<float> sigma{"sigma",
                      "Roughness \u03c3",
                      0.35f,
                      {0, 1.5707963f},
                      "Standard deviation of the slope angle; 0 is Lambert's model",
                      "rad"};
  auto parameters() { return std::tie(diffuse, sigma); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(OrenNayar<Rgb>::with_slope(base * diffuse, sigma));
  }
};

}  // namespace etendue
