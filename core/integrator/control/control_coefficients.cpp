#include "integrator/control/control_coefficients.h"

namespace etendue::integrator {

ControlSums& ControlSums::operator+=(const ControlSums& other) {
  difference += other.difference;
  albedo += other.albedo;
  overlap += other.overlap;
  return *this;
}

Rgb control_coefficient(const ControlSums& sums) {
  // m is 1/2 at most, where the two densities are equal everywhere; then K0 is zero, and c has no effect.
  constexpr float kLeast = 0.05f;  // of 1 - 2 m
  Rgb c(0);
  for (int i = 0; i < 3; ++i) {
    const float scale = std::max(sums.albedo[i] - 2 * sums.overlap[i], kLeast * sums.albedo[i]);
    if (scale > 0 && std::isfinite(sums.difference[i])) c[i] = sums.difference[i] / scale;
  }
  return c;
}

ControlCoefficients::ControlCoefficients(int width, int height)
    : columns_((width + kTile - 1) / kTile),
      sums_(static_cast<size_t>(columns_ * ((height + kTile - 1) / kTile))),
      coefficients_(sums_.size()) {}

void ControlCoefficients::compute(bool one_for_all) {
  if (one_for_all) {
    ControlSums all;
    for (const ControlSums& sums : sums_) all += sums;
    std::ranges::fill(coefficients_, control_coefficient(all));
  } else {
    std::ranges::transform(sums_, coefficients_.begin(), control_coefficient);
  }
}

}  // namespace etendue::integrator
