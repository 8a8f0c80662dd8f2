// Primitives of area lights: emissive triangles, and spheres and disks that are sampled in the same list.
#pragma once
#include <memory>

#include "geometry/analytic_shape.h"
#include "geometry/motion.h"
#include "spectrum/rgb.h"

namespace etendue {

// An emissive triangle in world space, or a whole sphere or disk.
struct AreaLightTriangle {
  static constexpr int kNoShape = -1;

  Vec3 p0, e1, e2;  // a corner and two edges, m
  uint32_t instance = 0, triangle = 0;
  Rgb radiance{0};  // along the normal, cd/m^2; of textured emission the mean, for choosing lights
  bool double_sided = false;
  bool textured = false;      // the radiance varies over the triangle; the scene has the value at a point
  bool moving = false;        // this is the triangle at the middle of the shutter interval
  Vec3 cross{0};              // e1 x e2, towards the front: its length is twice the area
  Vec3 normal{0};             // unit
  float area = 0;             // m^2
  float cosine_exponent = 0;  // the radiance is proportional to this power of the cosine to the normal
  int shape = kNoShape;       // index of a sphere or disk; of a triangle kNoShape

  bool is_analytic() const { return shape >= 0; }

  // The emission profile: the share of the radiance along the normal.
  float profile(float cosine) const { return cosine_exponent == 0 ? 1 : std::pow(std::abs(cosine), cosine_exponent); }
  // The probability of either side of a ray that leaves the triangle.
  float side_probability() const { return double_sided ? 0.5f : 1.0f; }
  // The density of a direction that leaves one side, per solid angle: proportional to the profile times the cosine.
  float direction_pdf(float cosine) const {
    return cosine_exponent == 0 ? cosine * kInvPi
                                : (cosine_exponent + 2) * 0.5f * kInvPi * std::pow(cosine, cosine_exponent + 1);
  }
  // Flux of all sides, lm: 2 pi A s L0 / (k + 2).
  Rgb flux() const { return radiance * (2 * kPi / (cosine_exponent + 2) * area * (double_sided ? 2.0f : 1.0f)); }

  void set_triangle(const Facet& facet) {
    p0 = facet.p0;
    e1 = facet.p1 - p0;
    e2 = facet.p2 - p0;
    cross = glm::cross(e1, e2) * facet.winding;
    const float length = glm::length(cross);
    normal = cross / length;
    area = 0.5f * length;
  }
  // `cross` is so long that the primitive counts as large from everywhere and is sampled as a shape.
  void set_shape(int index, const AnalyticShape& s) {
    shape = index;
    p0 = s.centre;
    e1 = e2 = Vec3(0);
    cross = Vec3(kLargerThanAnyArea, 0, 0);
    normal = s.frame.z;
    area = s.area();
  }

 private:
  static constexpr float kLargerThanAnyArea = 1e20f;  // its square is infinite in single precision
};

// The mesh and the motion of an instance whose emissive triangles move.
struct MovingEmitter {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Motion> motion;
};

// A sphere or disk that emits, at the middle of the shutter interval.
struct AnalyticAreaLight {
  AnalyticShape shape;
  std::shared_ptr<const Motion> motion = nullptr;  // of its node; null if it stands still

  AnalyticShape at(float time) const { return motion ? shape.placed(motion->matrix_at(time)) : shape; }
};

}  // namespace etendue
