// Maps from the unit square to directions and areas, each with its density.               thesis 6.3, 6.4
#pragma once
#include "base/vec.h"

namespace etendue {

// Concentric map of the unit square to the unit disk (Shirley and Chiu 1997): keeps strata in one piece.
inline Vec2 square_to_disk(Vec2 u) {
  const Vec2 p = 2.0f * u - 1.0f;
  if (p.x == 0 && p.y == 0) return Vec2(0);
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float r = wide ? p.x : p.y;
  const float phi = wide ? kPi / 4 * (p.y / p.x) : kPi / 2 - kPi / 4 * (p.x / p.y);
  return r * Vec2(std::cos(phi), std::sin(phi));
}

// Density cos(theta) / pi per solid angle around +z.
inline Vec3 square_to_cosine_hemisphere(Vec2 u) {
  const Vec2 d = square_to_disk(u);
  return Vec3(d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y));
}
inline float cosine_hemisphere_pdf(float cos_theta) { return cos_theta * kInvPi; }

// Density 1 / (4 pi) per solid angle.
inline Vec3 square_to_sphere(Vec2 u) {
  const float z = 1 - 2 * u.x;
  const float r = safe_sqrt(1 - z * z);
  const float phi = 2 * kPi * u.y;
  return Vec3(r * std::cos(phi), r * std::sin(phi), z);
}

// Density 1 / (2 pi (1 - cos_max)) per solid angle around +z.
inline Vec3 square_to_cone(Vec2 u, float cos_max) {
  const float z = 1 - u.x * (1 - cos_max);
  const float r = safe_sqrt(1 - z * z);
  const float phi = 2 * kPi * u.y;
  return Vec3(r * std::cos(phi), r * std::sin(phi), z);
}

// Barycentric weights of vertices 1 and 2, uniform over a triangle; the low-distortion map of Heitz 2019.
inline Vec2 square_to_triangle(Vec2 u) {
  if (u.y > u.x) {
    u.x *= 0.5f;
    u.y -= u.x;
  } else {
    u.y *= 0.5f;
    u.x -= u.y;
  }
  return u;
}

}  // namespace etendue
