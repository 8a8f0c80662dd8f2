#include "scene/structural_edit.h"

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "scene/builtin/shapes.h"
#include "scene/builtin/textured_shapes.h"
#include "scene/coordinate_range.h"
#include "scene/keyframes.h"

namespace etendue::scene {
namespace {

constexpr size_t kMaxNameLength = 1000;

Error impossible_edit(const std::string& message) { return usage_error(message); }

std::string node_label(const Scene& scene, int node) {
  const std::string& name = scene.nodes[static_cast<size_t>(node)].name;
  return name.empty() ? "node " + std::to_string(node) : "'" + name + "'";
}

bool is_valid_matrix(const Mat4& m) {
  for (int c = 0; c < 4; ++c)
    if (!is_within_range(Vec3(m[c])) || m[c].w != (c == 3 ? 1.0f : 0.0f)) return false;
  return true;
}

bool is_valid_transform(const Transform& t) {
  if (t.matrix) return is_valid_matrix(*t.matrix);
  const float length = glm::dot(t.rotation, t.rotation);
  return is_within_range(t.translation) && is_within_range(t.scale) && std::isfinite(length) && length > 0;
}

// A diffuse material with an albedo of 0.7.
Material new_material(const std::string& name) {
  constexpr float kAlbedo = 0.7f;
  Material material = diffuse(Rgb(kAlbedo));
  material.name = name;
  return material;
}

// A new root with the name and the transform of the edit.
Node& append_root(Scene& scene, const StructuralEdit& edit) {
  scene.roots.push_back(static_cast<int>(scene.nodes.size()));
  Node& node = scene.nodes.emplace_back();
  node.name = edit.name;
  node.transform = edit.transform;
  return node;
}

bool is_reached(const Scene& scene, int node) {
  return node >= 0 && static_cast<size_t>(node) < scene.nodes.size() && reached(scene)[static_cast<size_t>(node)];
}

Result<Scene> with_light(Scene scene, const StructuralEdit& edit) {
  if (!find_light_type(edit.type)) return impossible_edit("'" + edit.type + "' is not a type of light");
  Light light = make_light(edit.type);
  light.name = edit.name;
  scene.lights.push_back(std::move(light));
  append_root(scene, edit).light = static_cast<int>(scene.lights.size()) - 1;
  return scene;
}

Result<Scene> with_camera(Scene scene, const StructuralEdit& edit) {
  Camera camera = edit.camera;
  camera.name = edit.name;
  camera.to_world = Mat4(1);
  scene.cameras.push_back(std::move(camera));
  append_root(scene, edit).camera = static_cast<int>(scene.cameras.size()) - 1;
  return scene;
}

Result<Scene> with_shape(Scene scene, const StructuralEdit& edit) {
  Primitive primitive;
  primitive.mesh = textured_shape(edit.type);
  if (!primitive.mesh) return impossible_edit("'" + edit.type + "' is not a shape");
  scene.materials.push_back(new_material(edit.name));
  primitive.material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back({edit.name, {primitive}, {}});
  append_root(scene, edit).mesh = static_cast<int>(scene.meshes.size()) - 1;
  return scene;
}

// Lights and cameras are copied, because they are edited by themselves. Meshes and materials are shared.
Node copy_of(Scene& scene, int index) {
  Node copy = scene.nodes[static_cast<size_t>(index)];
  copy.children.clear();
  if (copy.light >= 0) {
    scene.lights.push_back(Light(scene.lights[static_cast<size_t>(copy.light)]));
    copy.light = static_cast<int>(scene.lights.size()) - 1;
  }
  if (copy.camera >= 0) {
    scene.cameras.push_back(Camera(scene.cameras[static_cast<size_t>(copy.camera)]));
    copy.camera = static_cast<int>(scene.cameras.size()) - 1;
  }
  return copy;
}

void attach(Scene& scene, int node, int parent) {
  scene.nodes[static_cast<size_t>(node)].parent = parent;
  (parent < 0 ? scene.roots : scene.nodes[static_cast<size_t>(parent)].children).push_back(node);
}

void set_name(Scene& scene, int index, const std::string& name) {
  Node& node = scene.nodes[static_cast<size_t>(index)];
  node.name = name;
  if (node.light >= 0) scene.lights[static_cast<size_t>(node.light)].name = name;
  if (node.camera >= 0) scene.cameras[static_cast<size_t>(node.camera)].name = name;
}

Result<Scene> with_duplicate(Scene scene, const StructuralEdit& edit) {
  const std::vector<int> originals = subtree_of(scene, edit.node);
  for (const int node : originals)
    if (scene.nodes[static_cast<size_t>(node)].skin >= 0)
      return impossible_edit(node_label(scene, node) +
                             " is placed by the joints of a skin, so a copy would be at the same place");
  const bool is_root = std::ranges::find(scene.roots, edit.node) != scene.roots.end();
  std::vector<int> copies;
  for (const int original : originals) {
    const int parent = scene.nodes[static_cast<size_t>(original)].parent;
    const auto position = std::ranges::find(originals, parent);
    Node copy = copy_of(scene, original);
    const int index = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(std::move(copy));
    const bool is_first = original == edit.node;
    if (is_first)
      attach(scene, index, is_root ? -1 : parent);
    else
      attach(scene, index, copies[static_cast<size_t>(position - originals.begin())]);
    copies.push_back(index);
  }
  set_name(scene, copies.front(), edit.name);
  return scene;
}

// A joint moves the vertices of a mesh, which would stay without it.
int skinned_node_of_joint(const Scene& scene, const std::vector<int>& nodes) {
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const bool stays = std::ranges::find(nodes, static_cast<int>(i)) == nodes.end();
    if (node.skin < 0 || !stays) continue;
    const auto& joints = scene.skins[static_cast<size_t>(node.skin)]->joints;
    if (std::ranges::any_of(nodes, [&](int n) { return std::ranges::find(joints, n) != joints.end(); }))
      return static_cast<int>(i);
  }
  return -1;
}

Result<Scene> without_node(Scene scene, const StructuralEdit& edit) {
  if (const int user = skinned_node_of_joint(scene, subtree_of(scene, edit.node)); user >= 0)
    return impossible_edit(node_label(scene, edit.node) + " contains joints that move " + node_label(scene, user) +
                           "; delete that object first");
  Node& node = scene.nodes[static_cast<size_t>(edit.node)];
  std::erase(scene.roots, edit.node);
  if (node.parent >= 0) std::erase(scene.nodes[static_cast<size_t>(node.parent)].children, edit.node);
  node.parent = -1;
  return scene;
}

Result<Scene> with_parent(Scene scene, const StructuralEdit& edit) {
  Node& node = scene.nodes[static_cast<size_t>(edit.node)];
  if (node.skin >= 0) return impossible_edit(node_label(scene, edit.node) + " is placed by the joints of a skin");
  if (edit.parent >= 0 && !is_reached(scene, edit.parent))
    return impossible_edit("the scene has no object " + std::to_string(edit.parent));
  if (std::ranges::count(subtree_of(scene, edit.node), edit.parent) > 0)
    return impossible_edit(node_label(scene, edit.parent) + " cannot be the parent of " +
                           node_label(scene, edit.node) + ": it is that object or below it");
  if (!is_valid_transform(edit.transform)) return impossible_edit("the transform of the object is out of range");
  std::erase(node.parent >= 0 ? scene.nodes[static_cast<size_t>(node.parent)].children : scene.roots, edit.node);
  node.transform = edit.transform;
  attach(scene, edit.node, edit.parent);
  return scene;
}

Result<Scene> with_object_edit(Scene scene, const StructuralEdit& edit) {
  const bool adds = edit.kind < EditKind::duplicate;
  if (adds && (edit.transform.matrix || !is_valid_transform(edit.transform)))
    return impossible_edit("the transform of a new object is out of range");
  if (!adds && !is_reached(scene, edit.node))
    return impossible_edit("the scene has no object " + std::to_string(edit.node));
  switch (edit.kind) {
    case EditKind::add_light:
      return with_light(std::move(scene), edit);
    case EditKind::add_camera:
      return with_camera(std::move(scene), edit);
    case EditKind::add_shape:
      return with_shape(std::move(scene), edit);
    case EditKind::duplicate:
      return with_duplicate(std::move(scene), edit);
    case EditKind::remove:
      return without_node(std::move(scene), edit);
    case EditKind::set_parent:
      return with_parent(std::move(scene), edit);
    default:
      set_name(scene, edit.node, edit.name);
      return scene;
  }
}

Error unknown_material(int material) {
  return usage_error("the scene has no material " + std::to_string(material));
}

std::string quoted_name(const std::string& name, const char* kind, int index) {
  return name.empty() ? kind + (" " + std::to_string(index)) : "'" + name + "'";
}

bool uses(const Primitive& primitive, int material) {
  return primitive.material == material || std::ranges::find(primitive.choices, material) != primitive.choices.end();
}

Result<Scene> with_material(Scene scene, const StructuralEdit& edit) {
  if (edit.material >= 0 && !has_material(scene, edit.material)) return unknown_material(edit.material);
  Material material =
      edit.material < 0 ? new_material(edit.name) : scene.materials[static_cast<size_t>(edit.material)];
  material.name = edit.name;
  scene.materials.push_back(std::move(material));
  return scene;
}

Result<Scene> without_material(Scene scene, const StructuralEdit& edit) {
  const std::string name =
      quoted_name(scene.materials[static_cast<size_t>(edit.material)].name, "material", edit.material);
  if (const int user = user_of_material(scene, edit.material); user >= 0)
    return usage_error(name + " is used by " + quoted_name(scene.nodes[static_cast<size_t>(user)].name, "node", user) +
                       "; assign another material to that object first");
  if (scene.removed_materials.size() + 1 == scene.materials.size())
    return usage_error(name + " is the only material of the scene");
  scene.removed_materials.push_back(edit.material);
  return scene;
}

// A mesh that other nodes show, too, is copied.
Result<Scene> with_assigned_material(Scene scene, const StructuralEdit& edit) {
  Node& node = scene.nodes[static_cast<size_t>(edit.node)];
  if (node.mesh < 0) return usage_error(quoted_name(node.name, "node", edit.node) + " has no surface");
  const auto count = static_cast<int>(scene.meshes[static_cast<size_t>(node.mesh)].primitives.size());
  if (edit.primitive < -1 || edit.primitive >= count)
    return usage_error(quoted_name(node.name, "node", edit.node) + " has no part " + std::to_string(edit.primitive));
  if (std::ranges::count(scene.nodes, node.mesh, &Node::mesh) > 1) {
    scene.meshes.push_back(MeshGroup(scene.meshes[static_cast<size_t>(node.mesh)]));
    node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  }
  auto& primitives = scene.meshes[static_cast<size_t>(node.mesh)].primitives;
  for (int i = 0; i < count; ++i) {
    if (edit.primitive >= 0 && edit.primitive != i) continue;
    primitives[static_cast<size_t>(i)].material = edit.material;
    primitives[static_cast<size_t>(i)].choices.clear();
  }
  return scene;
}

Result<Scene> with_texture(Scene scene, const StructuralEdit& edit) {
  if (edit.file.empty()) return usage_error("a texture needs the name of its file");
  Texture texture;
  texture.image = edit.image.pixels;
  texture.name = edit.file;
  if (!texture.image) scene.warnings.push_back(edit.file + ": cannot be read as an image; the texture is white");
  scene.textures.push_back(std::move(texture));
  return scene;
}

Result<Scene> with_material_edit(Scene scene, const StructuralEdit& edit) {
  if (edit.kind == EditKind::add_material) return with_material(std::move(scene), edit);
  if (edit.kind == EditKind::add_texture) return with_texture(std::move(scene), edit);
  if (!has_material(scene, edit.material)) return unknown_material(edit.material);
  if (edit.kind == EditKind::remove_material) return without_material(std::move(scene), edit);
  if (edit.kind == EditKind::assign_material) return with_assigned_material(std::move(scene), edit);
  scene.materials[static_cast<size_t>(edit.material)].name = edit.name;
  return scene;
}

Result<Scene> with_keyframe_edit(Scene scene, const StructuralEdit& edit) {
  if (!is_reached(scene, edit.node))
    return impossible_edit("the scene has no object " + std::to_string(edit.node));
  if (edit.kind == EditKind::remove_keyframe)
    return without_keyframe(std::move(scene), edit.node, edit.animation, edit.time);
  if (edit.transform.matrix || !is_valid_transform(edit.transform))
    return impossible_edit("the transform of the keyframe is out of range");
  return with_keyframe(std::move(scene), edit.node, edit.animation, edit.time, edit.transform);
}

}  // namespace

const std::vector<ShapeType>& shape_types() {
  static const std::vector<ShapeType> types{{"sphere", "Sphere"}, {"plane", "Plane"}, {"box", "Box"}, {"disk", "Disk"}};
  return types;
}

Result<Scene> with_edit(Scene scene, const StructuralEdit& edit) {
  if (edit.name.size() > kMaxNameLength) return impossible_edit("a name has at most 1000 characters");
  if (edit.kind >= EditKind::set_keyframe) return with_keyframe_edit(std::move(scene), edit);
  if (edit.kind < EditKind::add_material) return with_object_edit(std::move(scene), edit);
  if (edit.kind == EditKind::assign_material && !is_reached(scene, edit.node))
    return impossible_edit("the scene has no object " + std::to_string(edit.node));
  return with_material_edit(std::move(scene), edit);
}

Result<Scene> with_edits(Scene scene, const std::vector<StructuralEdit>& edits) {
  for (const StructuralEdit& edit : edits) {
    auto changed = with_edit(std::move(scene), edit);
    if (!changed) return changed;
    scene = std::move(*changed);
  }
  return scene;
}

Result<void> read_image(StructuralEdit& edit) {
  if (edit.kind != EditKind::add_texture || edit.image.pixels) return {};
  const auto bytes = read_file(edit.file);
  if (!bytes) return bytes.error();
  auto pixels = image::decode_image(*bytes, edit.file);
  if (!pixels) return pixels.error();
  edit.image.pixels = std::make_shared<const image::Image>(std::move(*pixels));
  return {};
}

bool has_material(const Scene& scene, int material) {
  return material >= 0 && static_cast<size_t>(material) < scene.materials.size() &&
         std::ranges::find(scene.removed_materials, material) == scene.removed_materials.end();
}

int user_of_material(const Scene& scene, int material) {
  const std::vector<bool> is_reached = reached(scene);
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const int mesh = scene.nodes[i].mesh;
    if (!is_reached[i] || mesh < 0) continue;
    const auto& primitives = scene.meshes[static_cast<size_t>(mesh)].primitives;
    if (std::ranges::any_of(primitives, [&](const Primitive& p) { return uses(p, material); }))
      return static_cast<int>(i);
  }
  return -1;
}

std::vector<int> subtree_of(const Scene& scene, int node) {
  std::vector<int> list{node};
  for (size_t i = 0; i < list.size(); ++i) {
    const auto& children = scene.nodes[static_cast<size_t>(list[i])].children;
    list.insert(list.end(), children.begin(), children.end());
  }
  return list;
}

std::vector<bool> reached(const Scene& scene) {
  std::vector<bool> marks(scene.nodes.size());
  for (const int root : scene.roots)
    for (const int node : subtree_of(scene, root)) marks[static_cast<size_t>(node)] = true;
  return marks;
}

}  // namespace etendue::scene
