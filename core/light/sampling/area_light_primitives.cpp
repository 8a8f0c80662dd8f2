#include "light/sampling/area_light_primitives.h"

#include "light/light_type_traits.h"
#include "light/sampling/spherical_triangle.h"

namespace etendue {
namespace {

LightBounds triangle_bounds(const AreaLightTriangle& t) {
  LightBounds b;
  b.box.extend(t.p0);
  b.box.extend(t.p0 + t.e1);
  b.box.extend(t.p0 + t.e2);
  b.axis = normalize_or(t.cross, Vec3(0, 1, 0));
  b.normals = 0;
  b.two_sided = t.double_sided;
  b.intensity = t.area * luminance(t.radiance);
  return b;
}

LightBounds shape_bounds(const AreaLightTriangle& t, const AnalyticShape& shape) {
  return with_type_of<LightBounds>(shape.kind, [&]<class Type>(std::type_identity<Type>) {
    return Type::bounds(shape, t.double_sided, t.area * luminance(t.radiance));
  });
}

// From a direction with the density cosine / pi to one with a density proportional to cosine^(k + 1).
Vec3 narrowed(const Vec3& d, float cosine_exponent) {
  const float sin2 = sqr(d.x) + sqr(d.y);
  const float z = std::pow(std::max(1 - sin2, 0.0f), 1 / (cosine_exponent + 2));
  const float scale = sin2 > 0 ? safe_sqrt((1 - z * z) / sin2) : 0;
  return {d.x * scale, d.y * scale, z};
}

}  // namespace

AreaLightPrimitives::AreaLightPrimitives(std::vector<AreaLightTriangle> triangles, std::vector<MovingEmitter> movers,
                                         std::vector<AnalyticAreaLight> shapes)
    : triangles_(std::move(triangles)), movers_(std::move(movers)), shapes_(std::move(shapes)) {}

AreaLightTriangle AreaLightPrimitives::moved(const AreaLightTriangle& triangle, float time) const {
  AreaLightTriangle t = triangle;
  const MovingEmitter& mover = movers_[t.instance];
  t.set_triangle(mover.motion->facet_at(*mover.mesh, mover.mesh->triangles[t.triangle], time));
  return t;
}

LightBounds AreaLightPrimitives::bounds(uint32_t i) const {
  const AreaLightTriangle& t = triangles_[i];
  if (t.is_analytic()) {
    const AnalyticAreaLight& light = shape_of(t);
    const auto at = [&](float time) { return shape_bounds(t, light.at(time)); };
    return light.motion ? bounds_over_time(*light.motion, at) : at(0);
  }
  if (!t.moving) return triangle_bounds(t);
  return bounds_over_time(*movers_[t.instance].motion, [&](float time) { return triangle_bounds(moved(t, time)); });
}

float AreaLightPrimitives::pdf(uint32_t i, const Vec3& from, const Vec3& point, float time, bool by_solid_angle) const {
  const AreaLightTriangle& light = triangles_[i];
  if (light.is_analytic()) return shape_pdf(light, from, point, time, by_solid_angle);
  const Vec3 to_light = point - from;
  const float distance2 = length_squared(to_light);
  return with_triangle(i, time, [&](const AreaLightTriangle& t) {
    const float facing = std::abs(glm::dot(t.cross, to_light));
    if (!(facing > 0)) return 0.0f;
    if (by_solid_angle && is_large(t.p0 - from, t.e1, t.e2, t.cross))
      if (const SphericalTriangle seen(t.p0 - from, t.e1, t.e2); seen.can_be_sampled()) return 1 / seen.solid_angle();
    return 2 * distance2 * std::sqrt(distance2) / facing;
  });
}

void AreaLightPrimitives::sample_shape(const AreaLightTriangle& t, float probability, const Vec3& from, Vec2 u,
                                       float time, bool by_solid_angle, LightSample& s) const {
  const AnalyticShape shape = shape_of(t).at(time);
  s.pdf = 0;
  const bool found = with_type_of<bool>(shape.kind, [&]<class Type>(std::type_identity<Type>) {
    if (by_solid_angle) return Type::sample_from(shape, from, u, s.barycentric);
    s.barycentric = Type::sample_area(u);
    return true;
  });
  if (!found) return;
  const Vec3 point = shape.point_at(s.barycentric);
  const Vec3 to_light = point - from;
  s.distance = glm::length(to_light);
  if (!(s.distance > 0)) return;
  s.wi = to_light / s.distance;
  const float facing = -glm::dot(shape.normal_at(s.barycentric), s.wi);
  if (t.double_sided ? facing == 0 : !(facing > 0)) return;
  s.pdf = probability * shape_pdf(t, from, point, time, by_solid_angle);
}

float AreaLightPrimitives::shape_pdf(const AreaLightTriangle& t, const Vec3& from, const Vec3& point, float time,
                                     bool by_solid_angle) const {
  const AnalyticShape shape = shape_of(t).at(time);
  if (!by_solid_angle) return pdf_of_uniform_point(shape, from, point);
  return with_type_of<float>(shape.kind,
                             [&]<class Type>(std::type_identity<Type>) { return Type::pdf_from(shape, from, point); });
}

void AreaLightPrimitives::sample_emission(const EmissionRandom& random, float probability, Emission& e) const {
  const AreaLightTriangle& t = triangles_[e.light];
  if (t.is_analytic())
    e.barycentric = with_type_of<Vec2>(
        shape_of(t).shape.kind, [&]<class Type>(std::type_identity<Type>) { return Type::sample_area(random.point); });
  else
    e.barycentric = square_to_triangle({random.point.x, random.point.y});
  resample_emission(random.direction, random.cosine_direction, probability, e);
  e.radiance = t.radiance;
  e.textured = t.textured;
  if (!(e.direction.z > 0) || !(e.density.first < kInfinity)) return;
  // For diffuse emission the cosine cancels.
  e.weight = t.cosine_exponent == 0 ? kPi / (t.side_probability() * e.density.first)
                                    : e.direction.z / (e.density.first * e.density.second);
}

void AreaLightPrimitives::resample_emission(Vec2 u, const Vec3& cosine_direction, float probability,
                                            Emission& e) const {
  const AreaLightTriangle& t = triangles_[e.light];
  // By component: a copy of a vector that was just written by component stalls.
  e.direction = {cosine_direction.x, cosine_direction.y, cosine_direction.z};
  if (t.double_sided) {
    // The first half of u.x is the front, the second the back.
    e.back = u.x >= 0.5f;
    const float x = std::min(2 * (u.x - (e.back ? 0.5f : 0)), kOneMinusEpsilon);
    e.direction = square_to_cosine_hemisphere({x, u.y});
  }
  if (t.cosine_exponent != 0) e.direction = narrowed(e.direction, t.cosine_exponent);
  const EmissionDensity density = emission_density(e.light, probability, e.direction.z, e.time);
  e.density.first = density.first;
  e.density.second = density.second;
  e.density.delta = false;
  e.density.infinite = false;
}

}  // namespace etendue
