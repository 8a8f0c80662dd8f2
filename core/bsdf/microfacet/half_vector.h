// Half vectors of two directions on the upper side, and the Jacobian of reflection about them.
#pragma once
#include "bsdf/microfacet/ggx.h"

namespace etendue {

// The smallest roughness along one axis of an anisotropic lobe whose other axis is rough. Float directions do not
// resolve narrower lobes.
inline constexpr float kMinAlpha = 1e-3f;

// The unit half vector.
inline Vec3 half_vector(const Vec3& o, const Vec3& i) { return normalize_or(o + i, Vec3(0, 0, 1)); }

// The unit half vector and its cosine to either direction, half the length of their sum. The result is bit-identical
// when o and i are exchanged.
struct HalfVector {
  Vec3 h;
  float cosine;

  HalfVector(const Vec3& o, const Vec3& i) : h(o + i) {
    const float length = std::sqrt(length_squared(h));
    cosine = 0.5f * length;
    h = length > 0 ? h / length : Vec3(0, 0, 1);
  }
};

// Solid angle of the half vector over that of the reflected direction, 1 / (4 <o, h>) [Lang, eq. 4.283-4.286].
inline float half_vector_jacobian(const Vec3& o, const Vec3& h) { return 1 / (4 * glm::dot(o, h)); }

}  // namespace etendue
