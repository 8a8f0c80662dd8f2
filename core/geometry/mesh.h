// Triangle meshes: the arrays that ray intersection and shading share.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/vec.h"

namespace etendue {

using Triangle = std::array<uint32_t, 3>;

// Front faces are counter-clockwise. `normals`, `tangents`, `uvs` and `colors` are empty or as long as `positions`. The
// meshes of a scene::CompiledScene are immutable and shared. `positions` must have capacity for one more element than
// its size, because Embree reads 16 bytes at the last vertex.
struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<Vec3> normals;
  std::vector<Vec4> tangents;  // w is the handedness, +1 or -1
  std::array<std::vector<Vec2>, 2> uvs;
  std::vector<Vec4> colors;  // linear RGBA

  // In bytes, of the arrays.
  size_t memory() const {
    return positions.size() * sizeof(Vec3) + triangles.size() * sizeof(Triangle) + normals.size() * sizeof(Vec3) +
           tangents.size() * sizeof(Vec4) + (uvs[0].size() + uvs[1].size()) * sizeof(Vec2) +
           colors.size() * sizeof(Vec4);
  }
};

// An axis-aligned bounding box; empty by default.
struct Bounds {
  Vec3 min{kInfinity}, max{-kInfinity};

  bool empty() const { return !(min.x <= max.x); }
  void extend(const Vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void extend(const Bounds& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  Vec3 center() const { return 0.5f * (min + max); }
  // Of the bounding sphere around the centre.
  float radius() const { return empty() ? 0 : 0.5f * glm::length(max - min); }
};

// The bounds of the transformed vertices.
Bounds bounds_of(const Mesh& mesh, const Mat4& transform);

}  // namespace etendue
