// Reconstruction of a function on surfaces from its values at elements: constant, or linear between vertices (Gouraud
// shading).                                                                                  [Lang, sec. 10.1.7]
#pragma once
#include <array>
#include <vector>

#include "radiosity/patch_mesh.h"
#include "spectrum/rgb.h"

namespace etendue::radiosity {

enum class Reconstruction : uint8_t { constant, linear };

// The vertices of the patches. Patches share a vertex if they meet there at an angle below 30 degrees.
class PatchVertices {
 public:
  PatchVertices() = default;
  explicit PatchVertices(const PatchMesh& mesh);

  bool empty() const { return corners_.empty(); }
  // The values at the vertices, for both sides: area-weighted means over the elements that share the vertex.
  std::vector<Rgb> at_vertices(const PatchMesh& mesh, const std::vector<Rgb>& by_element) const;
  // The value at a location from the result of `at_vertices`.
  Rgb interpolate(const std::vector<Rgb>& vertices, const PatchMesh::Location& at) const {
    const auto& corner = corners_[at.element / 2];
    const size_t side = at.element % 2;
    const auto value = [&](size_t k) { return vertices[2 * size_t{corner[k]} + side]; };
    return value(0) * (1 - at.barycentric.x - at.barycentric.y) + value(1) * at.barycentric.x +
           value(2) * at.barycentric.y;
  }
  // At most, while the vertices are found: the corners, and up to three vertices in a hash table.
  static constexpr size_t kBytesPerPatch = 3 * (sizeof(uint32_t) + 64);
  size_t memory() const { return corners_.capacity() * sizeof(corners_[0]); }

 private:
  std::vector<std::array<uint32_t, 3>> corners_;  // by patch
  uint32_t count_ = 0;
};

}  // namespace etendue::radiosity

template <>
struct etendue::Options<etendue::radiosity::Reconstruction> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"constant", "Constant per patch"}, {"linear", "Linear between vertices"}}};
};
