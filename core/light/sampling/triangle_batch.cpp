#include "light/sampling/triangle_batch.h"

#include "base/warp.h"
#include "light/sampling/spherical_triangle.h"

namespace etendue {

// A uniform point has density 1 / area per area, times distance^2 / cosine per solid angle. The length of `cross` is
// twice the area.
ETENDUE_VECTORIZE void TriangleBatch::sample_area(const LightQueries& queries, Points& points) const {
#pragma GCC ivdep
  for (size_t i = 0; i < padded_lanes(queries.count); ++i) {
    const Vec2 b = square_to_triangle({queries.u0[i], queries.u1[i]});
    const Vec3 to_p0 = p0[i] - queries.from[i];
    const Vec3 to_light = to_p0 + b.x * e1[i] + b.y * e2[i];
    const float distance2 = length_squared(to_light);
    const float distance = std::sqrt(distance2);
    const float scale = 1 / distance;
    const Vec3 wi = to_light * scale;
    // The cosine at the light times |cross|, negative at the back.
    const float facing = -glm::dot(cross[i], wi);
    const float emitting = std::max(facing, 0.0f) + std::max(-facing, 0.0f) * back[i];
    const float pdf = 2 * distance2 * probability[i] / emitting;
    points.wi.set(i, wi);
    points.distance[i] = distance;
    points.b1[i] = b.x;
    points.b2[i] = b.y;
    points.pdf[i] = emitting > 0 && pdf < kInfinity ? pdf : 0;
    points.large[i] = is_large(to_p0, e1[i], e2[i], cross[i]) ? 1 : 0;
  }
}

void TriangleBatch::sample_solid_angle(const LightQueries& queries, size_t i, Points& points) const {
  const SphericalTriangle seen(p0[i] - queries.from[i], e1[i], e2[i]);
  if (points.pdf[i] == 0 || !seen.can_be_sampled()) return;
  const auto point = seen.sample({queries.u0[i], queries.u1[i]});
  points.wi.set(i, point.direction);
  points.distance[i] = point.distance;
  points.b1[i] = point.barycentric.x;
  points.b2[i] = point.barycentric.y;
  points.pdf[i] = probability[i] / seen.solid_angle();
}

}  // namespace etendue
