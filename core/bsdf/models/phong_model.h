// Phong's model as a BRDF.                                                          thesis (4.234), item 53, E15
//
//   f = rho_d / pi + rho_s cos^n(theta_ro) / cos_i
//
// Not reciprocal, since only one of the cosines is divided by; its albedo grows without bound towards grazing incidence
// (39 at 89 degrees for rho_s = 1, n = 1), and is 2 pi rho_s / (n + 2) at normal incidence: it tends to zero, not to a
// mirror, as n grows.
#pragma once
#include "bsdf/lobes/cosine_power.h"

namespace etendue {

struct PhongModel : PhongParameters {
  static constexpr BsdfModelDescription kDescription{
      "phong", "Phong (BRDF)", ModelClass::phenomenological,
      "f = rho_d/pi + rho_s cos^n / cos_i about the mirrored direction. Not reciprocal, and its albedo exceeds any "
      "bound "
      "at grazing incidence.",
      "by cos^n about the mirrored direction; what falls below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  PhongModel() : PhongParameters("rho_s: the height of the lobe, in 1/sr") {}

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    PhongParameters::add_lobes(base, 1, true, lobes);
  }
};

}  // namespace etendue
