// Cylinder light: the lateral surface of a cylinder emits, like a fluorescent tube.                [Lang, sec. 4.3]
//
//   E = pi L R / d    of a receiver that faces the axis of a long tube at distance d, for diffuse emission
//
// Rays hit the exact surface; the ends are open and nothing is emitted inside. A direction from the receiver has two
// coordinates: alpha, the angle to the axis' perpendicular in the plane across the axis, and s, the sine of the angle
// out of that plane. Their solid angle is d alpha d s. alpha is uniform over the arc that the tube subtends, s is
// uniform between the two ends as they are seen at alpha:
//
//   p = 1 / (2 asin(R / d) (s1(alpha) - s0(alpha)))    per solid angle
//
// Every sampled point faces the receiver.
#pragma once
#include "light/sampling/analytic_shape_sampling.h"
#include "light/sampling/tube_directions.h"
#include "light/types/area_light_parameters.h"

namespace etendue {

struct CylinderLight : AreaLightParameters {
  static constexpr LightTypeDescription kDescription{
      .name = "cylinder",
      .label = "Cylinder light",
      .summary = "A tube that emits; black and visible to rays",
      .light_class = LightClass::area,
      .quantity = &kLuminance,
      .formula = "L(theta) = L0 cos^k theta; power 2 pi A L0 / (k + 2), A = 2 pi R length",
      .sampling = "directions: uniform over the arc across the axis, then by solid angle along the axis",
      .source = "[Lang, sec. 4.3]",
  };

  Number<float> radius = size_parameter("radius", "Radius", 0.05f, "Radius of the tube; node scale has no effect");
  Number<float> length = size_parameter("length", "Length", 1, "Along the node's x axis");
  auto parameters() { return std::tuple_cat(parameters_with_size(radius, length), std::tie(point_samples)); }

  float area() const { return 2 * kPi * radius * length; }

  AnalyticShape shape() const {
    AnalyticShape shape;
    shape.kind = kShape;
    shape.radius = radius;
    shape.half_length = 0.5f * length;
    return shape;
  }

  LightPlace point_sample(const SpreadPoint& p) const {
    LightPlace place;
    place.direction = Vec3(0, p.circle());
    place.position = Vec3((p.fraction - 0.5f) * length, 0, 0) + radius.value * place.direction;
    return place;
  }

  // ---- Sampling of cylinders in world space.

  static constexpr AnalyticShape::Kind kShape = AnalyticShape::Kind::cylinder;

  static Vec2 sample_area(Vec2 u) { return 2.0f * u - 1.0f; }

  static bool sample_from(const AnalyticShape& shape, const Vec3& from, Vec2 u, Vec2& at) {
    const TubeDirections directions(shape, from);
    if (!directions.any()) return false;
    at = directions.sample(u);
    return true;
  }
  static float pdf_from(const AnalyticShape& shape, const Vec3& from, const Vec3& point) {
    return TubeDirections(shape, from).pdf(point);
  }

  // From the side a tube emits as much as a rectangle of its diameter: 1 / pi of its area.
  static LightBounds bounds(const AnalyticShape& shape, bool, float intensity) {
    LightBounds b;
    b.box.extend(shape.centre - shape.extent());
    b.box.extend(shape.centre + shape.extent());
    b.intensity = intensity * kInvPi;
    return b;
  }
};

}  // namespace etendue
