// Motion of a mesh while the shutter is open                                            [Lang, sec. 8.4.3.3, eq. 8.61]
//
// A Motion stores poses at times evenly spaced from the opening (time 0) to the closing of the shutter (time 1).
// Between two steps, all numbers are interpolated linearly, as Embree does, so that shading uses the points that rays
// hit. The number of steps must be large enough for the interpolation to approximate the motion.
#pragma once
#include <vector>

#include "geometry/mesh.h"

namespace etendue {

// The vertices of a deforming mesh at one time step, in world space. `positions` has capacity for one more element (see
// Mesh).
struct DeformedVertices {
  std::vector<Vec3> positions, normals;
  std::vector<Vec4> tangents;
};

// A triangle at one time, in world space.
struct Facet {
  Vec3 p0, p1, p2;
  float winding;  // -1 if front faces are clockwise, else 1
};

// The segment between two of `steps` evenly spaced time steps that contains a time in [0, 1].
struct TimeSegment {
  size_t step;  // the first of the two steps
  float t;      // position in the segment, in [0, 1]
};
inline TimeSegment time_segment(float time, size_t steps) {
  const auto segments = static_cast<float>(steps - 1);
  const float position = time * segments, step = std::min(std::floor(position), segments - 1);
  return {static_cast<size_t>(step), position - step};
}

struct Motion {
  static constexpr size_t kMaxSteps = 129;  // limit of Embree

  std::vector<Mat4> to_world;              // transforms of a rigid mesh, or
  std::vector<DeformedVertices> vertices;  // vertices of a deforming mesh
  bool mirrored = false;                   // a deforming mesh has the winding -1

  bool deforms() const { return !vertices.empty(); }
  size_t steps() const { return deforms() ? vertices.size() : to_world.size(); }

  // The transform of a rigid mesh. Times are in [0, 1].
  Mat4 matrix_at(float time) const;
  Facet facet_at(const Mesh& mesh, const Triangle& triangle, float time) const;
  // Interpolated normal and tangent in world space, not normalised, at the barycentric weights u and v of vertices 1
  // and
  // 2. The mesh must have normals or tangents.
  Vec3 normal_at(const Mesh& mesh, const Triangle& triangle, float u, float v, float time) const;
  Vec4 tangent_at(const Mesh& mesh, const Triangle& triangle, float u, float v, float time) const;
};

}  // namespace etendue
