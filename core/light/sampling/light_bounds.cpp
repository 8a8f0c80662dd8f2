#include "light/sampling/light_bounds.h"

namespace etendue {
namespace {

Vec3 any_perpendicular(const Vec3& v) {
  return glm::normalize(std::abs(v.x) > 0.5f ? Vec3(-v.y, v.x, 0) : Vec3(0, -v.z, v.y));
}

// The smallest cone around two cones of directions.
void unite_cones(Vec3& axis, float& angle, Vec3 other_axis, float other_angle) {
  if (angle < other_angle) {
    std::swap(axis, other_axis);
    std::swap(angle, other_angle);
  }
  if (angle >= kPi) return;
  const float cosine = std::clamp(glm::dot(axis, other_axis), -1.0f, 1.0f);
  // For nearly equal directions the arc cosine is inaccurate; the arc sine of half the chord is not.
  const float between = cosine > 0.9f ? 2 * std::asin(0.5f * glm::distance(axis, other_axis)) : std::acos(cosine);
  if (between + other_angle <= angle) return;
  const float united = 0.5f * (angle + between + other_angle);
  const float rotation = united - angle;
  if (united >= kPi) {
    angle = kPi;
    return;
  }
  const Vec3 across = normalize_or(other_axis - cosine * axis, any_perpendicular(axis));
  axis = glm::normalize(std::cos(rotation) * axis + std::sin(rotation) * across);
  angle = united;
}

}  // namespace

void LightBounds::extend(const LightBounds& other) {
  if (box.empty()) {
    *this = other;
    return;
  }
  two_sided = two_sided || other.two_sided;
  unite_cones(axis, normals, two_sided && glm::dot(axis, other.axis) < 0 ? -other.axis : other.axis, other.normals);
  emission = std::max(emission, other.emission);
  box.extend(other.box);
  intensity += other.intensity;
  range = std::max(range, other.range);
}

}  // namespace etendue
