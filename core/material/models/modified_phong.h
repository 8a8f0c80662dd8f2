// The modified Phong model of Lafortune and Willems, 1994.                          thesis (4.248), item 58, E17, E18
//
//   f = rho_d / pi + rho_s (n + 2) / (2 pi) cos^n(theta_ro),    rho_d + rho_s <= 1
//
// Reciprocal; its albedo is rho_d + rho_s at normal incidence and less elsewhere (rho_d + rho_s cos for a large n):
// darkening towards grazing angles is a property of it.
#pragma once
#include "material/cosine_power.h"
#include "material/lambert.h"
#include "material/model_description.h"

namespace etendue {

struct ModifiedPhongModel {
  static constexpr ModelDescription kDescription{
      "modified-phong", "Phong, modified (Lafortune and Willems)", ModelClass::phenomenological,
      "f = rho_d/pi + rho_s (n + 2)/(2 pi) cos^n about the mirrored direction. Reciprocal; conserves energy for rho_d "
      "+ "
      "rho_s up to 1, and darkens towards grazing angles.",
      "by cos^n about the mirrored direction; what falls below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "rho_d, as a factor on the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.3f), {0, 1}, "rho_s: the albedo of the lobe at normal incidence"};
  Number<float> exponent{"exponent", "Exponent",        20, {0, 1e5f}, "n: 1 is matte, above 100 glossy",
                         "",         Scale::logarithmic};
  auto parameters() { return std::tie(diffuse, specular, exponent); }

  template <class Mix>
  void add_lobes(const Rgb& base, Mix& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
    CosinePower<Rgb> lobe;
    lobe.scale = rgb_of(specular) * ((exponent + 2) / (2 * kPi)), lobe.exponent = exponent;
    lobe.albedo = average(rgb_of(specular));
    lobes.add(lobe);
  }
};

}  // namespace etendue
