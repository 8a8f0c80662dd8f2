// Edits that add objects to a scene, remove them or rename them.
//
// Indices of nodes, lights, cameras, meshes and materials stay valid: an edit appends to the arrays of the scene, and
// a removed node stays in its array without a parent. The edits of a document can therefore be applied again to the
// scene as it was opened, and parameters ("node.7.translation.x") name the same object as before.
#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

enum class EditKind : uint8_t { add_light, add_camera, add_shape, duplicate, remove, rename };

struct StructuralEdit {
  EditKind kind = EditKind::add_light;
  int node = -1;             // that is duplicated, removed or renamed
  std::string type = {};     // of the light or the shape that is added
  std::string name = {};     // of the object that is added, or the new name
  Transform transform = {};  // of the object that is added; without a matrix
  Camera camera = {};        // that is added, without a position

  friend bool operator==(const StructuralEdit&, const StructuralEdit&) = default;
};

// A shape that can be added, as a triangle mesh with a material of its own.
struct ShapeType {
  const char* name;   // in files and commands
  const char* label;  // in menus
};
// "sphere" (radius 1 m), "plane" (2 m x 2 m), "box" (edges of 2 m) and "disk" (radius 1 m), all around the origin.
const std::vector<ShapeType>& shape_types();

// The scene after the edit. The error says why an edit is impossible; the scene may have changed since it was made.
// An edit that adds an object or duplicates one appends its node: a duplicate's node follows the former last one.
Result<Scene> with_edit(Scene scene, const StructuralEdit& edit);
// The scene after all edits, in their order.
Result<Scene> with_edits(Scene scene, const std::vector<StructuralEdit>& edits);

// For each node, whether a root reaches it. Removed nodes are not reached.
std::vector<bool> reached(const Scene& scene);

// The scene without the nodes that the edits have removed, and without the lights, cameras and meshes that only these
// used. Indices change.
Scene without_removed(const Scene& scene, const std::vector<StructuralEdit>& edits);

}  // namespace etendue::scene
