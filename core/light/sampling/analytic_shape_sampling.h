// Sampling of spheres and disks: what the types with an analytic shape share.
#pragma once
#include "base/warp.h"
#include "geometry/analytic_shape.h"
#include "light/sampling/light_bounds.h"

namespace etendue {

// The density of a point uniform over the surface, per solid angle at `from`: r^2 / (A cos). Zero for a point seen
// edge-on, or where the density is no float.
inline float pdf_of_uniform_point(const AnalyticShape& shape, const Vec3& from, const Vec3& point) {
  const Vec3 to_light = point - from;
  const float distance2 = length_squared(to_light);
  const float facing = std::abs(glm::dot(shape.normal_at(shape.uv_of(point)), to_light));
  const float pdf = distance2 * std::sqrt(distance2) / (shape.area() * facing);
  return facing > 0 && pdf < kInfinity ? pdf : 0;
}

}  // namespace etendue
