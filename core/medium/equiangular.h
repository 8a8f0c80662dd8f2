// Distances along a ray in proportion to the inverse square of the distance to a point.  [Kulla and Fajardo 2012, sec. 3]
//
//   p(t) = D / ((theta_b - theta_a) (D^2 + (t - t_0)^2)),    t = t_0 + D tan((1 - u) theta_a + u theta_b)
//
// where t_0 is the ray's parameter closest to the point, D the distance of the point from the ray there, and theta the
// angle of a point of the ray as seen from the point. It cancels the inverse square of the light's distance.
#pragma once
#include <cmath>

#include "base/vec.h"

namespace etendue {

// A part of a ray by distances in metres; empty unless from < to.
struct DistanceInterval {
  float from = 0, to = 0;

  bool empty() const { return !(from < to); }
};

// The part of an interval of a ray inside a cone, whose half angle has the given cosine. Cones of more than a quarter
// turn do not restrict the interval. All directions are unit vectors.
inline DistanceInterval inside_cone(const Vec3& origin, const Vec3& direction, DistanceInterval interval,
                                    const Vec3& apex, const Vec3& axis, float cosine) {
  if (!(cosine > 0)) return interval;
  // A point at x from the apex is inside if (x.axis)^2 > cos^2 x^2 and x.axis > 0.
  const Vec3 start = origin - apex;
  const double along = glm::dot(start, axis), rate = glm::dot(direction, axis), cosine2 = sqr(double{cosine}),
               a = rate * rate - cosine2, b = along * rate - cosine2 * double{glm::dot(start, direction)},
               c = along * along - cosine2 * double{glm::dot(start, start)}, discriminant = b * b - a * c;
  double low = -HUGE_VAL, high = HUGE_VAL;
  if (discriminant <= 0) {
    if (a <= 0) return {};  // the whole line is outside both nappes
  } else if (a < 0) {
    const double root = std::sqrt(discriminant);
    low = (-b + root) / a, high = (-b - root) / a;
    // The line meets one nappe between the roots, or the other one.
    if (along + 0.5 * (low + high) * rate < 0) return {};
  } else if (a > 0) {
    // Beyond the roots, on the side where the axis is approached.
    const double root = std::sqrt(discriminant);
    if (rate > 0)
      low = (-b + root) / a;
    else
      high = (-b - root) / a;
  }
  return {std::max(interval.from, static_cast<float>(low)), std::min(interval.to, static_cast<float>(high))};
}

class EquiangularDistance {
 public:
  // `interval` is not empty, but may be infinite. `direction` is a unit vector.
  EquiangularDistance(const Vec3& origin, const Vec3& direction, DistanceInterval interval, const Vec3& point)
      : interval_(interval), closest_(glm::dot(point - origin, direction)) {
    // A point on the ray has no angles; the bound keeps the density finite.
    constexpr float kLeast = 1e-6f;
    const Vec3 across = point - origin - direction * closest_;
    distance_ = std::max(std::sqrt(length_squared(across)), kLeast * (1 + std::abs(closest_)));
    first_angle_ = std::atan((interval.from - closest_) / distance_);
    angle_ = std::atan((interval.to - closest_) / distance_) - first_angle_;
  }

  float sample(float u) const {
    const float t = closest_ + distance_ * std::tan(first_angle_ + u * angle_);
    return std::clamp(t, interval_.from, interval_.to);
  }
  // The density per metre.
  float pdf(float t) const {
    const float along = t - closest_;
    if (t < interval_.from || t > interval_.to) return 0;
    return angle_ > 0 ? distance_ / (angle_ * (distance_ * distance_ + along * along)) : 0;
  }

 private:
  DistanceInterval interval_;
  float closest_, distance_, first_angle_, angle_;
};

}  // namespace etendue
