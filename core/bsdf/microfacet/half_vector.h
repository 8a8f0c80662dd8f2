// The half vector of two directions, and what a density of half vectors is for the directions that they reflect to.
#pragma once
#include "bsdf/microfacet/ggx.h"

namespace etendue {

// The least slope of facets across grooves: a lobe that is long one way and narrower the other would be a needle that
// directions in floats do not resolve.
inline constexpr float kMinAlpha = 1e-3f;

// Of directions on the upper side, whose sum always has a direction.
inline Vec3 half_vector(const Vec3& o, const Vec3& i) { return normalize_or(o + i, Vec3(0, 0, 1)); }

// The same with the cosine to either of them, which is half the length of their sum: exchanging them changes no bit.
struct HalfVector {
  Vec3 h;
  float cosine;

  HalfVector(const Vec3& o, const Vec3& i) : h(o + i) {
    const float length = std::sqrt(length_squared(h));
    cosine = 0.5f * length;
    h = length > 0 ? h / length : Vec3(0, 0, 1);
  }
};

// Solid angle of h over that of the reflected direction: 1 / (4 <o, h>).          thesis (4.283), item 59
inline float half_vector_jacobian(const Vec3& o, const Vec3& h) { return 1 / (4 * glm::dot(o, h)); }

}  // namespace etendue
