// Maps from the unit square to directions and areas, and their densities                    [Lang, sec. 6.3-6.4]
//
// Arguments are uniform points of [0, 1)^2. Densities of directions are per solid angle.
#pragma once
#include "base/vectorize.h"

namespace etendue {

// (cos x, sin x) for |x| <= pi/4, with an error of at most 2e-7.
inline Vec2 cos_sin_of_octant(float x) {
  const float x2 = x * x;
  const float cosine = 1 + x2 * (-0.5f + x2 * (4.166662e-2f + x2 * (-1.388794e-3f + x2 * 2.453e-5f)));
  const float sine = x * (1 + x2 * (-0.16666667f + x2 * (8.3333037e-3f + x2 * (-1.9839335e-4f + x2 * 2.7183e-6f))));
  return {cosine, sine};
}

// Uniform point on the unit disk, by the concentric map [Shirley and Chiu 1997], which maps compact strata to compact
// strata. Branch-free, because branches on random numbers are mispredicted.
inline Vec2 square_to_disk(Vec2 u) {
  const Vec2 p = 2.0f * u - 1.0f;
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float r = select(wide, p.x, p.y), other = select(wide, p.y, p.x);
  // At the centre (r = 0) the angle is arbitrary; the division must only be defined.
  const Vec2 d = r * cos_sin_of_octant(kPi / 4 * other / select(r == 0, 1.0f, r));
  return Vec2(select(wide, d.x, d.y), select(wide, d.y, d.x));
}

// Direction around +z with density cos(theta) / pi.
inline Vec3 square_to_cosine_hemisphere(Vec2 u) {
  const Vec2 d = square_to_disk(u);
  return Vec3(d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y));
}
// square_to_cosine_hemisphere for `count` points. All arrays hold padded_lanes(count) elements.
void squares_to_cosine_hemisphere(const float* u0, const float* u1, size_t count, const Vec3LanesView& directions);
inline float cosine_hemisphere_pdf(float cos_theta) { return cos_theta * kInvPi; }

// Uniform direction, with density 1 / (4 pi).
inline Vec3 square_to_sphere(Vec2 u) {
  const float z = 1 - 2 * u.x;
  const float r = safe_sqrt(1 - z * z);
  const float phi = 2 * kPi * u.y;
  return Vec3(r * std::cos(phi), r * std::sin(phi), z);
}

// Uniform direction within a cone around +z, with density 1 / (2 pi (1 - cos_max)).
inline Vec3 square_to_cone(Vec2 u, float cos_max) {
  const float z = 1 - u.x * (1 - cos_max);
  const float r = safe_sqrt(1 - z * z);
  const float phi = 2 * kPi * u.y;
  return Vec3(r * std::cos(phi), r * std::sin(phi), z);
}

// Uniform point of a triangle as the barycentric weights of vertices 1 and 2; low-distortion map [Heitz 2019].
inline Vec2 square_to_triangle(Vec2 u) { return u - 0.5f * std::min(u.x, u.y); }

}  // namespace etendue
