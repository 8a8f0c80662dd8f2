// The modified Phong model of Lafortune and Willems, 1994.                          thesis (4.248), item 58, E17, E18
//
//   f = rho_d / pi + rho_s (n + 2) / (2 pi) cos^n(theta_ro),    rho_d + rho_s <= 1
//
// Reciprocal; its albedo is rho_d + rho_s at normal incidence and less elsewhere (rho_d + rho_s cos for a large n):
// darkening towards grazing angles is a property of it.
#pragma once
#include "bsdf/lobes/cosine_power.h"

namespace etendue {

struct ModifiedPhongModel : PhongParameters {
  static constexpr BsdfModelDescription kDescription{
      "modified-phong", "Phong, modified (Lafortune and Willems)", ModelClass::phenomenological,
      "f = rho_d/pi + rho_s (n + 2)/(2 pi) cos^n about the mirrored direction. Reciprocal; conserves energy for rho_d "
      "+ "
      "rho_s up to 1, and darkens towards grazing angles.",
      "by cos^n about the mirrored direction; what falls below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  ModifiedPhongModel() : PhongParameters("rho_s: the albedo of the lobe at normal incidence") {}

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    PhongParameters::add_lobes(base, (exponent + 2) / (2 * kPi), false, lobes);
  }
};

}  // namespace etendue
