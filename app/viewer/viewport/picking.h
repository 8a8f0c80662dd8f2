// The relation between pixels of the viewport and points of the scene.
#pragma once
#include <optional>

#include "base/vec.h"
#include "geometry/mesh.h"
#include "scene/forward.h"
#include "viewer/viewport/placement.h"

namespace etendue::render {
struct Document;
}

namespace etendue::viewer {

// The surface that is visible at a position.
struct PickedSurface {
  Vec3 position{0};
  float axial_distance = 0;  // along the camera axis, like the focus distance
  int node = -1;
  int material = -1;
};

// `image` is the rectangle of the window that the image fills. Nothing outside the image or where there is no surface.
std::optional<PickedSurface> pick(const render::Document& document, const scene::CompiledScene& scene,
                                  const Placement& image, Vec2 position);

// The bounds of a node in world space; empty if it shows nothing.
Bounds bounds_of_node(const scene::CompiledScene& scene, int node);

}  // namespace etendue::viewer
