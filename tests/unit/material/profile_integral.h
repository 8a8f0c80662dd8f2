// The integral of a diffusion profile.
#pragma once
#include <cmath>

namespace etendue::test {

// The integral of R / A over the plane within a radius, by the midpoint rule in the square root of the radius.
template <class Profile>
double share_within(const Profile& profile, double radius) {
  constexpr int kSteps = 40'000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double root = std::sqrt(radius) * (i + 0.5) / kSteps;
    const double r = root * root;
    sum += 2 * M_PI * r * static_cast<double>(profile.value(static_cast<float>(r))) * 2 * root * std::sqrt(radius) /
           kSteps;
  }
  return sum;
}

}  // namespace etendue::test
