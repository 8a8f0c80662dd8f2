// Powers of cosines, and directions that are distributed by them.
#pragma once
#include "base/vec.h"

namespace etendue {

// cosine^exponent, 0 for cosines that are not above 0.
inline float power(float cosine, float exponent) { return cosine > 0 ? std::pow(cosine, exponent) : 0.0f; }

// Density (n + 1) / (2 pi) cos^n per solid angle around +z.
inline Vec3 square_to_cosine_power(Vec2 u, float exponent) {
  // z = u^(1 / (n + 1)), by its sine: of narrow lobes the cosine has not the digits.
  const float sin2 = -std::expm1(2 / (exponent + 1) * std::log(u.x));
  const float r = std::sqrt(sin2), z = safe_sqrt(1 - sin2);
  const float phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// The slope of facets whose highlight is about as wide as cos^n of the angle between mirrored and viewing direction:
// cos^(4n) of the angle to the half vector, and that is a Beckmann distribution of slope^2 = 2 / (4n).
inline float alpha_of_exponent(float exponent) { return std::min(1.0f, std::sqrt(0.5f / exponent)); }

}  // namespace etendue
