// Sphere light: a sphere that emits.                                                            [Lang, sec. 4.3]
//
//   E = pi L (R / d)^2    of a receiver that faces the centre at distance d, for diffuse emission
//
// Rays hit the exact sphere. Directions are uniform over the cone that it subtends [Shirley et al. 1996].
#pragma once
#include "light/sampling/analytic_shape_sampling.h"
#include "light/sampling/sphere_cone.h"
#include "light/types/area_light_parameters.h"

namespace etendue {

struct SphereLight : AreaLightParameters {
  static constexpr LightTypeDescription kDescription{
      .name = "sphere",
      .label = "Sphere light",
      .summary = "A sphere that emits; black and visible to rays",
      .light_class = LightClass::area,
      .quantity = &kLuminance,
      .formula = "L(theta) = L0 cos^k theta; power 2 pi A L0 / (k + 2), A = 4 pi R^2",
      .sampling = "directions uniform over the cone that it subtends",
      .source = "[Lang, sec. 4.3; Shirley et al. 1996]",
  };

  Number<float> radius = size_parameter("radius", "Radius", 0.5f, "Radius of the sphere; node scale has no effect");
  auto parameters() { return std::tuple_cat(parameters_with_size(radius), std::tie(point_samples)); }

  float area() const { return 4 * kPi * radius * radius; }

  AnalyticShape shape() const {
    AnalyticShape shape;
    shape.kind = kShape;
    shape.radius = radius;
    return shape;
  }

  // One point on each of n zones of equal area.
  LightPlace point_sample(const SpreadPoint& p) const {
    LightPlace place;
    const float z = 1 - 2 * p.fraction;
    place.direction = Vec3(safe_sqrt(1 - z * z) * p.circle(), z);
    place.position = radius.value * place.direction;
    return place;
  }

  // ---- Sampling of spheres in world space.

  static constexpr AnalyticShape::Kind kShape = AnalyticShape::Kind::sphere;

  static Vec2 sample_area(Vec2 u) { return octahedral_encode(square_to_sphere(u)); }

  static bool sample_from(const AnalyticShape& shape, const Vec3& from, Vec2 u, Vec2& at) {
    const Vec3 out = from - shape.centre;
    const float distance2 = length_squared(out);
    const float radius2 = sqr(shape.radius);
    if (!(distance2 > radius2)) return false;
    at = octahedral_encode(SphereCone(radius2, distance2).sample_normal(out / std::sqrt(distance2), u));
    return true;
  }
  static float pdf_from(const AnalyticShape& shape, const Vec3& from, const Vec3&) {
    const Vec3 out = from - shape.centre;
    const float distance2 = length_squared(out);
    const float radius2 = sqr(shape.radius);
    return distance2 > radius2 ? SphereCone(radius2, distance2).pdf() : 0;
  }

  // A sphere emits as much in every direction as a disk of its radius that faces it: a quarter of its area.
  static LightBounds bounds(const AnalyticShape& shape, bool, float intensity) {
    LightBounds b;
    b.box.extend(shape.centre - shape.extent());
    b.box.extend(shape.centre + shape.extent());
    b.intensity = intensity / 4;
    return b;
  }
};

}  // namespace etendue
