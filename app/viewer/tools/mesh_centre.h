// The centre of the bounds of a node's mesh. The last result is kept, because computing it visits all vertices.
#pragma once
#include <vector>

#include "base/vec.h"
#include "scene/scene.h"

namespace etendue::viewer {

class MeshCentre {
 public:
  // In the space of the node, in which a transform of the node does not change it. The origin for a node without a mesh.
  Vec3 of(const scene::Scene& scene, int node) const;

 private:
  mutable std::vector<scene::Primitive> primitives_;  // of the last mesh
  mutable Vec3 centre_{0};
};

}  // namespace etendue::viewer
