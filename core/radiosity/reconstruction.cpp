#include "radiosity/reconstruction.h"

#include <cmath>
#include <unordered_map>

#include "base/hash.h"

namespace etendue::radiosity {
namespace {

constexpr float kLeastCosine = 0.8660254f;  // of 30 degrees

// Finds vertices by position in a grid of cells. Positions closer than half a cell are equal.
class VertexGrid {
 public:
  explicit VertexGrid(float cell) : cell_(cell) {}

  uint32_t find_or_add(const Vec3& position, const Vec3& normal) {
    const Vec3 low = glm::floor(position / cell_ - 0.5f);
    for (int k = 0; k < 8; ++k) {
      const Vec3 cell =
          low + Vec3(static_cast<float>(k & 1), static_cast<float>(k >> 1 & 1), static_cast<float>(k >> 2));
      for (auto [it, end] = vertices_.equal_range(key(cell)); it != end; ++it) {
        const Vertex& v = it->second;
        if (glm::distance(v.position, position) < 0.5f * cell_ && glm::dot(v.normal, normal) > kLeastCosine)
          return v.number;
      }
    }
    vertices_.emplace(key(glm::floor(position / cell_)), Vertex{position, normal, count_});
    return count_++;
  }
  uint32_t count() const { return count_; }

 private:
  struct Vertex {
    Vec3 position, normal;
    uint32_t number;
  };
  static uint64_t key(const Vec3& cell) {
    uint64_t h = 0;
    for (int i = 0; i < 3; ++i) h = mix_bits(h ^ static_cast<uint64_t>(static_cast<int64_t>(cell[i])));
    return h;
  }

  float cell_;
  std::unordered_multimap<uint64_t, Vertex> vertices_;
  uint32_t count_ = 0;
};

}  // namespace

PatchVertices::PatchVertices(const PatchMesh& mesh) {
  Bounds bounds;
  for (const Patch& p : mesh.patches())
    for (const Vec3& corner : {p.p0, p.p1, p.p2}) bounds.extend(corner);
  VertexGrid grid(std::max(2e-5f * bounds.radius(), std::numeric_limits<float>::min()));
  corners_.reserve(mesh.patches().size());
  for (const Patch& p : mesh.patches())
    corners_.push_back(
        {grid.find_or_add(p.p0, p.normal), grid.find_or_add(p.p1, p.normal), grid.find_or_add(p.p2, p.normal)});
  count_ = grid.count();
}

std::vector<Rgb> PatchVertices::at_vertices(const PatchMesh& mesh, const std::vector<Rgb>& by_element) const {
  std::vector<Rgb> sums(2 * size_t{count_});
  std::vector<float> areas(count_);
  for (size_t p = 0; p < corners_.size(); ++p) {
    const float area = mesh.patches()[p].area;
    for (const uint32_t vertex : corners_[p]) {
      areas[vertex] += area;
      for (size_t side = 0; side < 2; ++side) sums[2 * size_t{vertex} + side] += by_element[2 * p + side] * area;
    }
  }
  for (size_t i = 0; i < sums.size(); ++i) sums[i] /= areas[i / 2];
  return sums;
}

}  // namespace etendue::radiosity
