// Edits that add objects, materials, textures and keyframes to a scene, remove them, rename them or connect them.
//
// Indices of nodes, lights, cameras, meshes, materials and textures stay valid: an edit appends to the arrays of the
// scene, and a removed node or material stays in its array. The edits of a document can therefore be applied again to the
// scene as it was opened, and parameters ("node.7.translation.x") name the same object as before.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

enum class EditKind : uint8_t {
  add_light,
  add_camera,
  add_shape,
  duplicate,        // `node` with its children
  remove,           // `node` with its children
  rename,           // `node`
  set_parent,       // makes `node` a child of `parent`, or a root, with this transform
  add_material,     // a copy of `material`, or a diffuse one if that is -1
  rename_material,  // `material`
  remove_material,  // `material`, which no object may use
  assign_material,  // `material` to one primitive or to all primitives of the mesh of `node`, in all variants
  add_texture,      // from `file`
  set_keyframe,     // of `node` in `animation` at `time` (scene/keyframes.h)
  remove_keyframe
};

// The decoded pixels of a file. They are not part of the value of an edit, which is the name of the file.
struct DecodedImage {
  std::shared_ptr<const image::Image> pixels;

  friend bool operator==(const DecodedImage&, const DecodedImage&) { return true; }
};

struct StructuralEdit {
  EditKind kind = EditKind::add_light;
  int node = -1;
  std::string type = {};     // of the light or the shape that is added
  std::string name = {};     // of the object or material that is added, or the new name
  Transform transform = {};  // of the object that is added, without a matrix; or relative to the new parent
  int parent = -1;           // -1: none, the node becomes a root
  int material = -1;
  int primitive = -1;       // of the mesh of the node; -1: all
  std::string file = {};    // of the texture that is added
  DecodedImage image = {};  // the pixels of that file; null: the texture has no image, as if the file were missing
  Camera camera = {};       // that is added, without a position
  int animation = -1;       // that has the keyframe; -1: a new one
  float time = 0;           // of the keyframe, seconds

  friend bool operator==(const StructuralEdit&, const StructuralEdit&) = default;
};

// A shape that can be added, as a triangle mesh with a material of its own.
struct ShapeType {
  const char* name;   // in files and commands
  const char* label;  // in menus
};
// "sphere" (radius 1 m), "plane" (2 m x 2 m), "box" (edges of 2 m) and "disk" (radius 1 m), all around the origin.
const std::vector<ShapeType>& shape_types();

// Reads the image of an edit that adds a texture. Does nothing for other edits and if the edit has its image.
Result<void> read_image(StructuralEdit& edit);

// The scene after the edit. The error says why an edit is impossible; the scene may have changed since it was made.
// An edit that adds an object or duplicates one appends its node: a duplicate's node follows the former last one.
Result<Scene> with_edit(Scene scene, const StructuralEdit& edit);
// The scene after all edits, in their order.
Result<Scene> with_edits(Scene scene, const std::vector<StructuralEdit>& edits);

// For each node, whether a root reaches it. Removed nodes are not reached.
std::vector<bool> reached(const Scene& scene);
// The node and its descendants, parents first.
std::vector<int> subtree_of(const Scene& scene, int node);
// Whether there is a material of this index that was not removed.
bool has_material(const Scene& scene, int material);
// The first node that a root reaches and whose mesh uses the material, in any variant; -1 if there is none.
int user_of_material(const Scene& scene, int material);

// The scene without the nodes and materials that the edits have removed, without the lights, cameras and meshes that
// only these nodes used, and without the textures that the edits have added and no material uses. Indices change.
Scene without_removed(const Scene& scene, const std::vector<StructuralEdit>& edits);

}  // namespace etendue::scene
