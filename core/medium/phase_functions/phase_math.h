// Functions that several phase functions share.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

namespace etendue::phase {

inline constexpr double kInv4Pi = 0.25 * std::numbers::inv_pi;

// The largest |g|. At 1 the Henyey-Greenstein function is a delta. At 0.999 its peak is a tenth of a degree wide, which
// is far wider than the rounding errors of directions, so that densities stay finite and accurate.
inline constexpr double kMaxAsymmetry = 0.999;
inline double clamped_asymmetry(double g) { return std::clamp(g, -kMaxAsymmetry, kMaxAsymmetry); }

// [Henyey and Greenstein 1941], 1/sr. 1 + g^2 - 2 g x is written as a sum of terms that do not cancel.
inline double henyey_greenstein(double g, double x) {
  g = clamped_asymmetry(g);
  const double distance = g >= 0 ? (1 - g) * (1 - g) + 2 * g * (1 - x) : (1 + g) * (1 + g) - 2 * g * (1 + x);
  return kInv4Pi * (1 - g * g) / (distance * std::sqrt(distance));
}
// The inverse of its distribution function, in a form without the division by g.
inline double sample_henyey_greenstein(double g, double u) {
  g = clamped_asymmetry(g);
  const double s = 2 * u - 1, d = 1 + g * s;
  const double x = (s + g * (s * s + 3) / 2 + g * g * s + g * g * g * (s * s - 1) / 2) / (d * d);
  return std::clamp(x, -1.0, 1.0);
}

// Selects the first of two with probability p; `u` becomes uniform in [0, 1) again.
inline bool select_first(double p, double& u) {
  if (u < p) {
    u /= p;
    return true;
  }
  u = std::min((u - p) / (1 - p), 1.0);
  return false;
}

}  // namespace etendue::phase
