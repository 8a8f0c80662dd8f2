// Directions and random numbers for tests of surfaces.
#pragma once
#include <random>

#include "base/hash.h"
#include "bsdf/lobe.h"

namespace etendue::test {

inline Vec3 direction(float theta_degrees, float phi = 0.3f) {
  const float t = theta_degrees * kPi / 180;
  return {std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t)};
}

struct Draw {
  std::mt19937 engine;
  explicit Draw(unsigned seed) : engine(seed) {}
  float one() { return to_unit_float(static_cast<uint32_t>(engine())); }
  Vec2 two() { return {one(), one()}; }
  LobeRandom lobe() {
    const float choice = one();
    return {choice, two()};
  }
  Vec3 anywhere() { return direction(180 * one(), 6.28f * one()); }
  Vec3 upper() { return square_to_cosine_hemisphere(two()); }
};

}  // namespace etendue::test
