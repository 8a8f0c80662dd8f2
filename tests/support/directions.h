// Directions and reproducible random numbers for tests of BSDFs.
#pragma once
#include <random>

#include "base/hash.h"
#include "bsdf/lobe.h"

namespace etendue::test {

// The unit vector with this angle to the normal in degrees and this azimuth in radians.
inline Vec3 direction(float theta_degrees, float phi = 0.3f) {
  const float t = theta_degrees * kPi / 180;
  return {std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t)};
}

struct Random {
  std::mt19937 engine;
  explicit Random(unsigned seed) : engine(seed) {}
  // Uniform in [0, 1) and in the unit square.
  float uniform() { return to_unit_float(static_cast<uint32_t>(engine())); }
  Vec2 uniform2() {
    const float x = uniform();
    return {x, uniform()};
  }
  LobeRandom lobe() {
    const float choice = uniform();
    return {choice, uniform2()};
  }
  // Uniform in both angles: all directions, or those within max_theta degrees of the normal.
  Vec3 any_direction() { return direction_below(180, 6.28f); }
  Vec3 direction_below(float max_theta, float max_phi = 6) {
    const float theta = max_theta * uniform();
    return direction(theta, max_phi * uniform());
  }
  // Cosine-distributed in the upper hemisphere.
  Vec3 upper_direction() { return square_to_cosine_hemisphere(uniform2()); }
};

}  // namespace etendue::test
