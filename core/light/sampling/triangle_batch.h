// Points on the triangles that a batch of receivers chose, sampled together on wide registers.
#pragma once
#include "light/sampling/area_light_primitives.h"

namespace etendue {

struct TriangleBatch {
  static constexpr size_t kSize = 64;
  template <class T>
  using Array = std::array<T, kSize>;

  struct Points {
    Vec3Lanes<kSize> wi;
    alignas(64) Array<float> distance, pdf, b1, b2;
    alignas(64) Array<float> large;  // 1 where the triangle is to be sampled by solid angle, else 0

    void get(size_t i, LightSample& sample) const {
      sample.wi = wi[i];
      sample.distance = distance[i];
      sample.pdf = pdf[i];
      sample.barycentric = {b1[i], b2[i]};
    }
  };

  Vec3Lanes<kSize> p0, e1, e2, cross;
  alignas(64) Array<float> probability;  // of the choice
  alignas(64) Array<float> back;         // 1 if the triangle emits from its back, else 0

  void set(size_t i, const AreaLightTriangle& triangle, float choice_probability) {
    p0.set(i, triangle.p0);
    e1.set(i, triangle.e1);
    e2.set(i, triangle.e2);
    cross.set(i, triangle.cross);
    probability[i] = choice_probability;
    back[i] = triangle.double_sided ? 1 : 0;
  }

  // Points uniform over the triangles. The pdf includes the choice; it is 0 where the point shows its dark side.
  void sample_area(const LightQueries& queries, Points& points) const;
  // Replaces a point by one of a direction uniform over the spherical triangle. A point of pdf 0 and a triangle that
  // cannot be sampled by solid angle keep theirs.
  void sample_solid_angle(const LightQueries& queries, size_t i, Points& points) const;
};

}  // namespace etendue
