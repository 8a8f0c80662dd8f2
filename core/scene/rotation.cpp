#include "scene/rotation.h"

#include <glm/gtc/quaternion.hpp>

namespace etendue::scene {
namespace {

glm::dquat quaternion(const Vec4& q) { return glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)); }

Vec4 floats(const glm::dquat& q) { return Vec4(glm::dvec4(q.x, q.y, q.z, q.w)); }

// A quaternion of floats resolves about 1e-5 degrees. Angles closer than that to a multiple of 0.001 are rounded to it.
double without_noise(double degrees) {
  const double rounded = std::round(degrees * 1000) / 1000;
  return (std::abs(degrees - rounded) < 3e-5 ? rounded : degrees) + 0.0;  // -0 reads as 0
}

}  // namespace

Vec3 euler_degrees(const Vec4& rotation) {
  if (!(glm::dot(rotation, rotation) > 0)) return Vec3(0);
  const glm::dmat3 m = glm::mat3_cast(quaternion(rotation));
  // m = Z * Y * X; its first column is (cos y cos z, cos y sin z, -sin y).
  const double level = std::hypot(m[0].x, m[0].y);
  const double y = std::atan2(-m[0].z, level);
  // At y = +-90 degrees x and z rotate about the same axis (gimbal lock); x gets the whole rotation.
  const bool locked = level < 1e-6;
  const double x = locked ? std::atan2(-m[2].y, m[1].y) : std::atan2(m[1].z, m[2].z);
  const double z = locked ? 0 : std::atan2(m[0].y, m[0].x);
  const glm::dvec3 degrees = glm::degrees(glm::dvec3(x, y, z));
  return Vec3(without_noise(degrees.x), without_noise(degrees.y), without_noise(degrees.z));
}

Vec4 rotation_of(const Vec3& euler_degrees) {
  const glm::dvec3 r = glm::radians(glm::dvec3(euler_degrees));
  const glm::dquat x = glm::angleAxis(r.x, glm::dvec3(1, 0, 0)), y = glm::angleAxis(r.y, glm::dvec3(0, 1, 0)),
                   z = glm::angleAxis(r.z, glm::dvec3(0, 0, 1));
  return floats(glm::normalize(z * y * x));
}

std::optional<Transform> decompose(const Transform& transform) {
  if (!transform.matrix) return transform;
  const glm::dmat3 m(*transform.matrix);
  glm::dvec3 scale(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
  if (!(scale.x > 0 && scale.y > 0 && scale.z > 0) || !std::isfinite(scale.x + scale.y + scale.z)) return std::nullopt;
  if (glm::determinant(m) < 0) scale.x = -scale.x;
  const glm::dmat3 axes(m[0] / scale.x, m[1] / scale.y, m[2] / scale.z);
  constexpr double kTolerance = 1e-4;  // largest cosine between axes without shear
  const bool orthogonal = std::abs(glm::dot(axes[0], axes[1])) < kTolerance &&
                          std::abs(glm::dot(axes[1], axes[2])) < kTolerance &&
                          std::abs(glm::dot(axes[2], axes[0])) < kTolerance;
  if (!orthogonal) return std::nullopt;
  Transform parts;
  parts.translation = Vec3((*transform.matrix)[3]);
  parts.rotation = floats(glm::normalize(glm::quat_cast(axes)));
  parts.scale = Vec3(scale);
  return parts;
}

}  // namespace etendue::scene
