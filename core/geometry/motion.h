// How a mesh moves while the shutter is open.                                              thesis 8.3.4, (8.61)
//
// Poses at moments evenly spaced from the opening (time 0) to the closing (time 1), and straight lines from one to the
// next, number by number: that is how Embree finds hits, and what is shaded must lie where they are. Whoever makes a
// Motion chooses enough of them that the lines are the movement.
#pragma once
#include <vector>

#include "geometry/mesh.h"

namespace etendue {

// What moves of a mesh that deforms, in world space. `positions` has room for one more (see Mesh).
struct DeformedVertices {
  std::vector<Vec3> positions, normals;
  std::vector<Vec4> tangents;
};

// A triangle at one time, in world space.
struct Facet {
  Vec3 p0, p1, p2;
  float winding;  // -1 where front faces are clockwise, else 1
};

struct Motion {
  static constexpr size_t kMaxSteps = 129;  // that Embree takes

  std::vector<Mat4> to_world;              // of a mesh that keeps its shape, or
  std::vector<DeformedVertices> vertices;  // of one that does not
  bool mirrored = false;                   // one that does not keep its shape is turned as Facet::winding says

  bool deforms() const { return !vertices.empty(); }
  size_t steps() const { return deforms() ? vertices.size() : to_world.size(); }

  // Of a mesh that keeps its shape. Times are in [0, 1].
  Mat4 matrix_at(float time) const;
  Facet facet_at(const Mesh& mesh, const Triangle& triangle, float time) const;
  // At barycentric weights u and v of vertices 1 and 2; not unit. Of a mesh that has them.
  Vec3 normal_at(const Mesh& mesh, const Triangle& triangle, float u, float v, float time) const;
  Vec4 tangent_at(const Mesh& mesh, const Triangle& triangle, float u, float v, float time) const;
};

}  // namespace etendue
