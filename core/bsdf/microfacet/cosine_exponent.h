// Powers of cosines: evaluation, sampling and the equivalent microfacet roughness.
#pragma once
#include "base/vec.h"

namespace etendue {

// cosine^exponent; 0 if the cosine is not positive.
inline float power(float cosine, float exponent) { return cosine > 0 ? std::pow(cosine, exponent) : 0.0f; }

// Samples a direction around +z with density (n + 1) / (2 pi) cos^n per solid angle.
inline Vec3 square_to_cosine_power(Vec2 u, float exponent) {
  // z = u^(1 / (n + 1)), computed from the sine, because the cosine of a narrow lobe rounds to 1.
  const float sin2 = -std::expm1(2 / (exponent + 1) * std::log(u.x));
  const float r = std::sqrt(sin2), z = safe_sqrt(1 - sin2);
  const float phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// The Beckmann roughness alpha whose highlight is about as wide as cos^n of the angle between the mirror direction and
// the view direction. That is cos^(4n) of the angle between normal and half vector, which approximates a Beckmann
// distribution with alpha^2 = 2 / (4n).
inline float alpha_of_exponent(float exponent) { return std::min(1.0f, std::sqrt(0.5f / exponent)); }

}  // namespace etendue
