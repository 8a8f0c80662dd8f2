// Phong's model as a BRDF.                                                          thesis (4.234), item 53, E15
//
//   f = rho_d / pi + rho_s cos^n(theta_ro) / cos_i
//
// Not reciprocal, since only one of the cosines is divided by; its albedo grows without bound towards grazing incidence
// (39 at 89 degrees for rho_s = 1, n = 1), and is 2 pi rho_s / (n + 2) at normal incidence: it tends to zero, not to a
// mirror, as n grows.
#pragma once
#include "material/cosine_power.h"
#include "material/lambert.h"
#include "material/model_description.h"

namespace etendue {

struct PhongModel {
  static constexpr ModelDescription kDescription{
      "phong", "Phong (BRDF)", ModelClass::phenomenological,
      "f = rho_d/pi + rho_s cos^n / cos_i about the mirrored direction. Not reciprocal, and its albedo exceeds any "
      "bound "
      "at grazing incidence.",
      "by cos^n about the mirrored direction; what falls below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "rho_d, as a factor on the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.3f), {0, 1}, "rho_s: the height of the lobe, in 1/sr"};
  Number<float> exponent{"exponent", "Exponent",        20, {0, 1e5f}, "n: 1 is matte, above 100 glossy",
                         "",         Scale::logarithmic};
  auto parameters() { return std::tie(diffuse, specular, exponent); }

  template <class Mix>
  void add_lobes(const Rgb& base, Mix& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
    CosinePower<Rgb> lobe;
    lobe.scale = rgb_of(specular), lobe.exponent = exponent, lobe.over_cosine = true;
    lobe.albedo = average(lobe.scale) * 2 * kPi / (exponent + 2);
    lobes.add(lobe);
  }
};

}  // namespace etendue
