// Which nodes an edit moved, for scenes with so many instances that a new top level takes long.
#pragma once
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace etendue::scene {

struct MovedNode {
  uint32_t node;
  Mat4 to_world;
};

// The visible nodes whose world matrix an edit may have changed, with their new matrices. Nothing if the geometry or the
// hierarchy of the scenes differ otherwise, if a scene is animated, if a moved node has a light, a portal or a mesh that
// deforms, if a matrix is singular or out of range, or if more than `most` nodes moved.
std::optional<std::vector<MovedNode>> moved_nodes(const Scene& now, const Scene& old, size_t most);

}  // namespace etendue::scene
