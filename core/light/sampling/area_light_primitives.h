// The primitives of all area lights of a scene: where they are at a time, and the densities of their points and rays.
#pragma once
#include <vector>

#include "light/sampling/area_light_triangle.h"
#include "light/sampling/emission.h"
#include "light/sampling/light_bounds.h"

namespace etendue {

class AreaLightPrimitives {
 public:
  AreaLightPrimitives() = default;
  // `movers` has an entry per instance if any triangle moves. AreaLightTriangle::shape is an index into `shapes`.
  AreaLightPrimitives(std::vector<AreaLightTriangle> triangles, std::vector<MovingEmitter> movers,
                      std::vector<AnalyticAreaLight> shapes);

  size_t size() const { return triangles_.size(); }
  const AreaLightTriangle& operator[](size_t i) const { return triangles_[i]; }
  const std::vector<AreaLightTriangle>& triangles() const { return triangles_; }

  // The result of `use` for the triangle at a time.
  template <class Use>
  auto with_triangle(uint32_t i, float time, Use&& use) const {
    const AreaLightTriangle& t = triangles_[i];
    return t.moving ? use(moved(t, time)) : use(t);
  }
  // A moving triangle at a time.
  AreaLightTriangle moved(const AreaLightTriangle& triangle, float time) const;

  // The normal at a point, given by barycentric weights or the surface coordinates of a shape.
  Vec3 normal_at(uint32_t i, Vec2 at, float time) const {
    const AreaLightTriangle& t = triangles_[i];
    if (t.is_analytic()) return shape_of(t).at(time).normal_at(at);
    return t.moving ? moved(t, time).normal : t.normal;
  }
  // Over the whole shutter interval.
  LightBounds bounds(uint32_t i) const;

  // The cosine between normal and direction at a sampled point.
  float cosine_at(const LightSample& s, float time) const {
    return glm::dot(normal_at(s.light, s.barycentric, time), s.wi);
  }

  // The density of sampling a point of this primitive from a receiver, per solid angle. `by_solid_angle` is false where
  // points are uniform over the area (LightStrategy::emission_pdf).
  float pdf(uint32_t i, const Vec3& from, const Vec3& point, float time, bool by_solid_angle) const;
  // A point of a sphere or disk: direction, distance, surface coordinates, and pdf times `probability`.
  void sample_shape(const AreaLightTriangle& t, float probability, const Vec3& from, Vec2 u, float time,
                    bool by_solid_angle, LightSample& s) const;

  // A ray that leaves `e.light`: point, direction, radiance, densities and weight. `probability` is that of the light.
  void sample_emission(const EmissionRandom& random, float probability, Emission& e) const;
  // Another direction from the same point, with its densities. `cosine_direction` is `u` warped to the cosine
  // distribution.
  void resample_emission(Vec2 u, const Vec3& cosine_direction, float probability, Emission& e) const;
  // The density of a ray that leaves the primitive at this cosine to the normal. `probability` is that of the light.
  EmissionDensity emission_density(uint32_t i, float probability, float cosine, float time) const {
    return with_triangle(i, time, [&](const AreaLightTriangle& t) {
      return EmissionDensity{probability / t.area, t.side_probability() * t.direction_pdf(std::abs(cosine))};
    });
  }

 private:
  const AnalyticAreaLight& shape_of(const AreaLightTriangle& t) const { return shapes_[static_cast<size_t>(t.shape)]; }
  float shape_pdf(const AreaLightTriangle& t, const Vec3& from, const Vec3& point, float time,
                  bool by_solid_angle) const;

  std::vector<AreaLightTriangle> triangles_;
  std::vector<MovingEmitter> movers_;
  std::vector<AnalyticAreaLight> shapes_;
};

// Whether a triangle is sampled by solid angle: its area exceeds the square of the distance to its centroid. Compares
// squares, since `cross` is twice the area.
inline bool is_large(const Vec3& to_p0, const Vec3& e1, const Vec3& e2, const Vec3& cross) {
  constexpr float kMinAreaOverDistance2 = 1;
  const Vec3 to_centroid = to_p0 + (e1 + e2) * (1 / 3.0f);
  return sqr(length_squared(to_centroid) * (2 * kMinAreaOverDistance2)) < length_squared(cross);
}

}  // namespace etendue
