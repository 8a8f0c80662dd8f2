// An orthonormal frame at a surface point. The local z axis is the normal, the local x axis the tangent.
#pragma once
#include "base/vec.h"

namespace etendue {

struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Frame() = default;

  explicit Frame(const Vec3& normal) { build(normal); }
  Frame(const Vec3& normal, const Vec3& tangent, float handedness) { build(normal, tangent, handedness); }

  // With an arbitrary tangent; branch-free [Duff et al. 2017]. The frame is built in place, because copying values that
  // were just stored component by component causes store-forwarding stalls.
  void build(const Vec3& normal) {
    z = normal;
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    x = Vec3(1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    y = Vec3(b, sign + normal.y * normal.y * a, -normal.y);
  }

  // With the given tangent, projected into the plane of the normal. A tangent parallel to the normal is replaced by an
  // arbitrary one. `handedness` is +1 or -1, as TANGENT.w in glTF: y = handedness * cross(z, x).
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

  // Always inlined, because returning a vector in a register pair causes store-forwarding stalls.
  [[gnu::always_inline]] Vec3 to_local(const Vec3& v) const {
    return Vec3(glm::dot(v, x), glm::dot(v, y), glm::dot(v, z));
  }
  [[gnu::always_inline]] Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace etendue
