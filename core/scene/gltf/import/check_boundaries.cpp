// Warns of media whose boundary is not closed.
#include <algorithm>
#include <map>

#include "scene/gltf/file_error.h"
#include "scene/gltf/import/importers.h"

namespace etendue::scene::gltf {
namespace {

// Counts for each edge of triangles how often it is passed from its smaller to its larger vertex, minus how often in the
// other direction. In a closed, consistently oriented surface all counts are zero. Vertices at equal positions are one.
class EdgeBalance {
 public:
  void add(const Mesh& mesh) {
    std::vector<uint32_t> numbers;
    for (const Vec3& p : mesh.positions)
      numbers.push_back(vertices_.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(vertices_.size())).first->second);
    for (const Triangle& t : mesh.triangles)
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t a = numbers[t[i]], b = numbers[t[(i + 1) % 3]];
        if (a != b) balance_[std::minmax(a, b)] += a < b ? 1 : -1;
      }
  }
  bool is_closed() const {
    return std::ranges::all_of(balance_, [](const auto& edge) { return edge.second == 0; });
  }

 private:
  std::map<std::array<float, 3>, uint32_t> vertices_;
  std::map<std::pair<uint32_t, uint32_t>, int> balance_;
};

}  // namespace

void check_boundaries(Scene& scene) {
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    EdgeBalance edges;
    for (const Primitive& primitive : scene.meshes[m].primitives) {
      if (primitive.material < 0) continue;
      const Material& material = scene.materials[static_cast<size_t>(primitive.material)];
      if (material.is_solid() && material.medium.is_volume()) edges.add(*primitive.mesh);
    }
    if (edges.is_closed()) continue;
    scene.warnings.push_back(at("meshes", m) +
                             ": encloses a medium, but is not closed; where light leaves it through a gap, the medium "
                             "ends at the bounding box, and the image depends on the integrator");
  }
}

}  // namespace etendue::scene::gltf
