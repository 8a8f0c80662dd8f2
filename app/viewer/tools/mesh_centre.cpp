#include "viewer/tools/mesh_centre.h"

namespace etendue::viewer {

Vec3 MeshCentre::of(const scene::Scene& scene, int node) const {
  const int mesh = scene.nodes[static_cast<size_t>(node)].mesh;
  if (mesh < 0) return Vec3(0);
  const auto& primitives = scene.meshes[static_cast<size_t>(mesh)].primitives;
  if (primitives == primitives_) return centre_;
  Bounds bounds;
  for (const scene::Primitive& primitive : primitives) bounds.extend(bounds_of(*primitive.mesh, Mat4(1)));
  primitives_ = primitives;
  centre_ = bounds.empty() ? Vec3(0) : bounds.center();
  return centre_;
}

}  // namespace etendue::viewer
