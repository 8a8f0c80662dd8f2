// Oren and Nayar's qualitative model of rough clay and sand.                   thesis 4.2.2.5.3, item 66 (by name only)
//
// The formula is in material/oren_nayar.h. Reciprocal. Its albedo exceeds rho by up to 1.4 % towards grazing angles
// (1.0140 at 89 degrees for a slope of 10 degrees), and falls below it everywhere for steep slopes: its approximation
// of interreflection is not a closed balance. Slope 0 is Lambert's model.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/oren_nayar.h"

namespace etendue {

struct OrenNayarModel {
  static constexpr BsdfModelDescription kDescription{
      "oren-nayar", "Oren-Nayar (qualitative)", ModelClass::physical,
      "f = rho/pi (A + B max(0, cos dphi) sin a tan b): Lambertian grooves (1994). Reciprocal; its albedo exceeds rho "
      "by "
      "up to 1.4 % at grazing angles.",
      "by the cosine, which it differs from by the factor A + B sin a tan b alone"};
  template <class Color>
  using Lobes = std::tuple<OrenNayar<Color>>;

  Number<float> diffuse{
      "diffuse", "Diffuse", 1, {0, 1}, "Reflectance rho of the grooves' sides, times the base colour"};
  Number<float> sigma{"sigma", "Slope", 0.35f, {0, 1.5707963f}, "Standard deviation of the slope angle", "rad"};
  auto parameters() { return std::tie(diffuse, sigma); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(OrenNayar<Rgb>::of_slope(base * diffuse, sigma));
  }
};

}  // namespace etendue
