// The directions from a receiver to the lateral surface of a cylinder.                      (types/cylinder_light.h)
#pragma once
#include "geometry/analytic_shape.h"

namespace etendue {

class TubeDirections {
 public:
  TubeDirections(const AnalyticShape& tube, const Vec3& from) : tube_(tube) {
    const Vec3 out = from - tube.centre;
    const Vec3& axis = tube.frame.x;
    axial_ = glm::dot(out, axis);
    const Vec3 across = out - axial_ * axis;
    distance_ = glm::length(across);
    if (!any()) return;
    out_ = across / distance_;
    side_ = glm::cross(axis, out_);
    half_arc_ = std::asin(std::min(tube.radius / distance_, 1.0f));
  }

  // False where only the dark inside is seen: closer to the axis than the radius.
  bool any() const { return distance_ > tube_.radius && tube_.radius > 0 && tube_.half_length > 0; }

  // Surface coordinates of the point in a direction.
  Vec2 sample(Vec2 u) const {
    const float alpha = half_arc_ * (2 * u.x - 1);
    const Line line(*this, alpha);
    const float sine = line.low + u.y * line.range;
    const float along = line.across * sine / std::sqrt(std::max(1 - sine * sine, kSmallest));
    // The normal, seen from the axis: across * sin alpha to the side.
    const float to_side = line.across * std::sin(alpha) / tube_.radius;
    const Vec3 normal = safe_sqrt(1 - to_side * to_side) * out_ + to_side * side_;
    const float angle = std::atan2(glm::dot(normal, tube_.frame.z), glm::dot(normal, tube_.frame.y));
    return {std::clamp((axial_ + along) / tube_.half_length, -1.0f, 1.0f), angle * kInvPi};
  }

  // The density of `sample`, per solid angle, at a point of the surface; 0 at its back.
  float pdf(const Vec3& point) const {
    if (!any()) return 0;
    const Vec3 out = point - tube_.centre;
    const Vec3 normal = out - glm::dot(out, tube_.frame.x) * tube_.frame.x;  // times the radius
    if (!(distance_ * glm::dot(normal, out_) > tube_.radius * tube_.radius)) return 0;
    const float to_side = glm::dot(normal, side_);
    const float alpha = std::atan2(to_side, distance_ - glm::dot(normal, out_));
    const float range = Line(*this, alpha).range;
    return range > 0 ? 1 / (2 * half_arc_ * range) : 0;
  }

 private:
  static constexpr float kSmallest = 1e-12f;

  // The line of the surface that is seen at an angle: its distance across the axis, and the sines of the angles to its
  // ends out of the plane across the axis.
  struct Line {
    float across, low, range;

    Line(const TubeDirections& d, float alpha) {
      const float sine = std::sin(alpha);
      const float chord = safe_sqrt(sqr(d.tube_.radius) - sqr(d.distance_ * sine));
      const float power = (d.distance_ - d.tube_.radius) * (d.distance_ + d.tube_.radius);
      across = power / (d.distance_ * std::cos(alpha) + chord);
      const float first = -d.tube_.half_length - d.axial_, last = d.tube_.half_length - d.axial_;
      low = first / std::sqrt(sqr(across) + sqr(first));
      // sin b - sin a without cancellation for short or distant tubes.
      const float width = std::atan2(across * (last - first), sqr(across) + first * last);
      const float middle = std::atan2(first, across) + 0.5f * width;
      range = 2 * std::cos(middle) * std::sin(0.5f * width);
    }
  };

  const AnalyticShape& tube_;
  float axial_ = 0;     // of the receiver
  float distance_ = 0;  // of the receiver from the axis
  Vec3 out_{0}, side_{0};
  float half_arc_ = 0;  // radians
};

}  // namespace etendue
