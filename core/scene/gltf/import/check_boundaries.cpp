// Warns of media whose boundary is not closed.
#include <algorithm>
#include <array>

#include "scene/gltf/file_error.h"
#include "scene/gltf/import/importers.h"

namespace etendue::scene::gltf {
namespace {

// The directed edges of triangles. In a closed, consistently oriented surface every edge is passed equally often in
// both directions. Vertices at equal positions are one.
class BoundaryEdges {
 public:
  void add(const Mesh& mesh) {
    for (const Triangle& t : mesh.triangles)
      for (size_t i = 0; i < 3; ++i) add(mesh.positions[t[i]], mesh.positions[t[(i + 1) % 3]]);
  }
  bool is_closed() {
    std::ranges::sort(forward_);
    std::ranges::sort(backward_);
    return forward_ == backward_;
  }

 private:
  using Edge = std::array<float, 6>;  // the positions of its ends, the smaller one first
  void add(const Vec3& a, const Vec3& b) {
    const Edge edge{a.x, a.y, a.z, b.x, b.y, b.z}, reversed{b.x, b.y, b.z, a.x, a.y, a.z};
    if (edge < reversed) forward_.push_back(edge);
    if (reversed < edge) backward_.push_back(reversed);
  }

  std::vector<Edge> forward_, backward_;
};

}  // namespace

void check_boundaries(Scene& scene) {
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    BoundaryEdges edges;
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
