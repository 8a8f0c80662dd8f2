// Disk light: a disk that emits.                                                                [Lang, sec. 4.3]
//
//   E = pi L R^2 / (R^2 + h^2)    of a parallel receiver at height h on the axis, for diffuse emission
//
// Rays hit the exact disk. Points are uniform over its area.
#pragma once
#include "light/sampling/analytic_shape_sampling.h"
#include "light/types/area_light_parameters.h"

namespace etendue {

struct DiskLight : AreaLightParameters {
  static constexpr LightTypeDescription kDescription{
      .name = "disk",
      .label = "Disk light",
      .summary = "A disk that emits; black and visible to rays",
      .light_class = LightClass::area,
      .quantity = &kLuminance,
      .formula = "L(theta) = L0 cos^k theta; power 2 pi A L0 / (k + 2) per side, A = pi R^2",
      .sampling = "points uniform over its area",
      .source = "[Lang, sec. 4.3]",
  };

  Number<float> radius = size_parameter("radius", "Radius", 0.5f, "Radius of the disk; node scale has no effect");
  auto parameters() { return std::tuple_cat(parameters_with_size(radius), std::tie(two_sided, point_samples)); }

  float area() const { return kPi * radius * radius; }

  AnalyticShape shape() const {
    AnalyticShape shape;
    shape.kind = kShape;
    shape.radius = radius;
    return shape;
  }

  // One point on each of n rings of equal area.
  LightPlace point_sample(const SpreadPoint& p) const {
    LightPlace place;
    place.position = Vec3(radius * std::sqrt(p.fraction) * p.circle(), 0);
    return place;
  }

  // ---- Sampling of disks in world space.

  static constexpr AnalyticShape::Kind kShape = AnalyticShape::Kind::disk;

  static Vec2 sample_area(Vec2 u) { return square_to_disk(u); }

  static bool sample_from(const AnalyticShape&, const Vec3&, Vec2 u, Vec2& at) {
    at = sample_area(u);
    return true;
  }
  static float pdf_from(const AnalyticShape& shape, const Vec3& from, const Vec3& point) {
    return pdf_of_uniform_point(shape, from, point);
  }

  static LightBounds bounds(const AnalyticShape& shape, bool two_sided, float intensity) {
    LightBounds b;
    b.box.extend(shape.centre - shape.extent());
    b.box.extend(shape.centre + shape.extent());
    b.axis = shape.frame.z;
    b.normals = 0;
    b.two_sided = two_sided;
    b.intensity = intensity;
    return b;
  }
};

}  // namespace etendue
