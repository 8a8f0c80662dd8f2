// Phong's lobe without the cosine that made it depend on who looks at whom.              thesis (4.235), item 54
//
//   f = rho_d / pi + rho_s cos^n(theta_ro)
//
// Reciprocal. Not normalised: its albedo exceeds one where rho_d + 2 pi rho_s / (n + 2) does (2.09 for rho_s = n = 1).
#pragma once
#include "bsdf/lobes/cosine_power.h"

namespace etendue {

struct ReciprocalPhongModel : PhongParameters {
  static constexpr BsdfModelDescription kDescription{
      "reciprocal-phong", "Phong, reciprocal", ModelClass::phenomenological,
      "f = rho_d/pi + rho_s cos^n about the mirrored direction. Reciprocal; conserves energy only where rho_d + 2 pi "
      "rho_s/(n + 2) is at most 1.",
      "by cos^n about the mirrored direction; what falls below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  ReciprocalPhongModel() : PhongParameters("rho_s: the height of the lobe, in 1/sr") {}

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    PhongParameters::add_lobes(base, 1, false, lobes);
  }
};

}  // namespace etendue
