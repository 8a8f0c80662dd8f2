// An orthonormal frame around a surface normal: local z is the normal, local x the tangent.
#pragma once
#include "base/vec.h"

namespace etendue {

struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Frame() = default;

  explicit Frame(const Vec3& normal) { build(normal); }
  Frame(const Vec3& normal, const Vec3& tangent, float handedness) { build(normal, tangent, handedness); }

  // Any tangent will do. Branch-free construction of Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
  // (Built in place: copying what was just written number by number stalls the processor.)
  void build(const Vec3& normal) {
    z = normal;
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    x = Vec3(1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    y = Vec3(b, sign + normal.y * normal.y * a, -normal.y);
  }

  // The tangent is projected into the plane of the normal; one that is parallel to the normal gives any tangent.
  // `handedness` is +1 or -1 as glTF's TANGENT.w: y = handedness * cross(z, x).
  void build(const Vec3& normal, const Vec3& tangent, float handedness) {
    const Vec3 projected = tangent - normal * glm::dot(normal, tangent);
    const float squared = length_squared(projected);
    if (!(squared > 1e-12f * length_squared(tangent))) {
      build(normal);
      return;
    }
    z = normal;
    x = projected / std::sqrt(squared);
    y = glm::cross(z, x) * handedness;
  }

  // Always inline: a vector that is returned through a register pair stalls.
  [[gnu::always_inline]] Vec3 to_local(const Vec3& v) const {
    return Vec3(glm::dot(v, x), glm::dot(v, y), glm::dot(v, z));
  }
  [[gnu::always_inline]] Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace etendue
