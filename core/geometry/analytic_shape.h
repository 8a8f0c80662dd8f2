// Spheres, disks and lateral surfaces of cylinders, which are intersected analytically
//
// The surface coordinates (u, v) of a hit are in [-1, 1]^2. On a disk they are the position along its two axes; on a
// sphere they are the octahedral encoding of the direction from the centre [Meyer et al. 2010]; on a cylinder they are
// the position along its axis and the angle about it, over pi. For shading, the shape is replaced by a tangent triangle
// at the hit.
#pragma once
#include "base/frame.h"
#include "geometry/motion.h"

namespace etendue {

// Maps unit vectors to [-1, 1]^2 and back [Meyer et al. 2010].
inline Vec2 octahedral_encode(const Vec3& n) {
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  const Vec2 p = Vec2(n.x, n.y) / sum;
  if (n.z >= 0) return p;
  return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

inline Vec3 octahedral_decode(Vec2 p) {
  Vec3 n(p.x, p.y, 1 - std::abs(p.x) - std::abs(p.y));
  const float over = std::max(-n.z, 0.0f);
  n.x -= std::copysign(over, n.x);
  n.y -= std::copysign(over, n.y);
  return glm::normalize(n);
}

// The matrix with its axes scaled to unit length.
inline Mat4 without_scale(const Mat4& node) {
  Mat4 m = node;
  for (int axis = 0; axis < 3; ++axis) m[axis] = Vec4(normalize_or(Vec3(node[axis]), Vec3(0)), 0);
  return m;
}

struct AnalyticShape {
  enum class Kind : uint8_t { sphere, disk, cylinder };

  Kind kind = Kind::sphere;
  Vec3 centre{0};
  Frame frame;  // of a disk: x and y span it, z is its normal; of a cylinder: x is its axis
  float radius = 1;
  float half_length = 0;  // of a cylinder

  // The shape at the origin of a node. A disk is perpendicular to the z axis of the node and faces -z, a cylinder lies
  // along the x axis. The scale of the node is ignored.
  AnalyticShape placed(const Mat4& node) const {
    AnalyticShape s = *this;
    s.centre = Vec3(node[3]);
    s.frame.build(normalize_or(-Vec3(node[2]), Vec3(0, 0, -1)), Vec3(node[0]), 1);
    return s;
  }

  float area() const {
    if (kind == Kind::cylinder) return 4 * kPi * radius * half_length;
    return (kind == Kind::sphere ? 4 : 1) * kPi * radius * radius;
  }
  // Half the size of the bounding box around the centre.
  Vec3 extent() const {
    if (kind == Kind::sphere) return Vec3(radius);
    const auto across = [](const Vec3& axis) { return glm::sqrt(glm::max(Vec3(0), 1.0f - axis * axis)); };
    return kind == Kind::disk ? radius * across(frame.z) : radius * across(frame.x) + half_length * glm::abs(frame.x);
  }
  Vec3 normal_at(Vec2 uv) const {
    if (kind == Kind::cylinder) return std::cos(kPi * uv.y) * frame.y + std::sin(kPi * uv.y) * frame.z;
    return kind == Kind::sphere ? octahedral_decode(uv) : frame.z;
  }
  Vec3 point_at(Vec2 uv) const {
    if (kind == Kind::cylinder) return centre + uv.x * half_length * frame.x + radius * normal_at(uv);
    return kind == Kind::sphere ? centre + radius * octahedral_decode(uv)
                                : centre + radius * (uv.x * frame.x + uv.y * frame.y);
  }
  // The tangent triangle whose first corner is the point at `uv`.
  Facet facet_at(Vec2 uv) const {
    const Vec3 p = point_at(uv);
    const Frame tangent = kind == Kind::disk ? frame : Frame(normal_at(uv));
    return {p, p + radius * tangent.x, p + radius * tangent.y, 1};
  }
  // The coordinates of a point on the shape, up to rounding.
  Vec2 uv_of(const Vec3& point) const {
    const Vec3 v = point - centre;
    if (kind == Kind::cylinder)
      return {half_length > 0 ? std::clamp(glm::dot(v, frame.x) / half_length, -1.0f, 1.0f) : 0,
              std::atan2(glm::dot(v, frame.z), glm::dot(v, frame.y)) * kInvPi};
    return kind == Kind::sphere ? octahedral_encode(v / radius)
                                : Vec2(glm::dot(v / radius, frame.x), glm::dot(v / radius, frame.y));
  }
};

}  // namespace etendue
