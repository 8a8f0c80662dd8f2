#include "scene/structural_edit.h"

#include <algorithm>
#include <cmath>

#include "scene/builtin/shapes.h"
#include "scene/coordinate_range.h"

namespace etendue::scene {
namespace {

constexpr int kSphereRings = 48, kDiskSegments = 96;
constexpr float kDefaultAlbedo = 0.7f;
constexpr size_t kMaxNameLength = 1000;

std::shared_ptr<const Mesh> shape_mesh(const std::string& type) {
  if (type == "sphere") return sphere(1, kSphereRings, false);
  if (type == "plane") return quad(1);
  if (type == "box") return cube(1, false);
  if (type == "disk") return disk(1, kDiskSegments);
  return nullptr;
}

Error impossible_edit(const std::string& message) { return usage_error(message); }

std::string node_label(const Scene& scene, int node) {
  const std::string& name = scene.nodes[static_cast<size_t>(node)].name;
  return name.empty() ? "node " + std::to_string(node) : "'" + name + "'";
}

bool is_valid_transform(const Transform& t) {
  const float length = glm::dot(t.rotation, t.rotation);
  return !t.matrix && is_within_range(t.translation) && is_within_range(t.scale) && std::isfinite(length) && length > 0;
}

// A new root with the name and the transform of the edit.
Node& append_root(Scene& scene, const StructuralEdit& edit) {
  scene.roots.push_back(static_cast<int>(scene.nodes.size()));
  Node& node = scene.nodes.emplace_back();
  node.name = edit.name;
  node.transform = edit.transform;
  return node;
}

// The node and its descendants, parents first.
std::vector<int> subtree_of(const Scene& scene, int node) {
  std::vector<int> list{node};
  for (size_t i = 0; i < list.size(); ++i) {
    const auto& children = scene.nodes[static_cast<size_t>(list[i])].children;
    list.insert(list.end(), children.begin(), children.end());
  }
  return list;
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
  primitive.mesh = shape_mesh(edit.type);
  if (!primitive.mesh) return impossible_edit("'" + edit.type + "' is not a shape");
  Material material = diffuse(Rgb(kDefaultAlbedo));
  material.name = edit.name;
  scene.materials.push_back(std::move(material));
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

// New indices of the elements that stay, -1 for the others.
std::vector<int> indices_after_removal(const std::vector<bool>& is_removed) {
  std::vector<int> indices;
  int next = 0;
  for (const bool removed : is_removed) indices.push_back(removed ? -1 : next++);
  return indices;
}

template <class T>
void erase_marked(std::vector<T>& values, const std::vector<int>& indices) {
  size_t i = 0;
  std::erase_if(values, [&](const T&) { return indices[i++] < 0; });
}

void renumber(int& index, const std::vector<int>& indices) {
  if (index >= 0) index = indices[static_cast<size_t>(index)];
}

void renumber(std::vector<int>& list, const std::vector<int>& indices) {
  for (int& index : list) renumber(index, indices);
  std::erase(list, -1);
}

// Which of `count` objects are used by removed nodes only.
std::vector<bool> unused(const Scene& scene, const std::vector<bool>& removed, int Node::*member, size_t count) {
  std::vector<bool> by_removed(count), by_others(count);
  for (size_t i = 0; i < scene.nodes.size(); ++i)
    if (const int used = scene.nodes[i].*member; used >= 0)
      (removed[i] ? by_removed : by_others)[static_cast<size_t>(used)] = true;
  for (size_t i = 0; i < count; ++i) by_removed[i] = by_removed[i] && !by_others[i];
  return by_removed;
}

void renumber_references(Scene& scene, const std::vector<int>& nodes) {
  for (auto& skin : scene.skins) {
    // A skin with removed joints is used by removed nodes only. It keeps its number of joints.
    auto changed = std::make_shared<Skin>(*skin);
    for (int& joint : changed->joints) joint = std::max(nodes[static_cast<size_t>(joint)], 0);
    skin = std::move(changed);
  }
  for (auto& animation : scene.animations) {
    auto changed = std::make_shared<Animation>(*animation);
    for (AnimationChannel& channel : changed->channels)
      if (channel.node >= 0 && static_cast<size_t>(channel.node) < nodes.size()) renumber(channel.node, nodes);
    std::erase_if(changed->channels, [](const AnimationChannel& channel) { return channel.node < 0; });
    animation = std::move(changed);
  }
}

}  // namespace

const std::vector<ShapeType>& shape_types() {
  static const std::vector<ShapeType> types{{"sphere", "Sphere"}, {"plane", "Plane"}, {"box", "Box"}, {"disk", "Disk"}};
  return types;
}

Result<Scene> with_edit(Scene scene, const StructuralEdit& edit) {
  if (edit.name.size() > kMaxNameLength) return impossible_edit("a name has at most 1000 characters");
  const bool adds = edit.kind < EditKind::duplicate;
  if (adds && !is_valid_transform(edit.transform))
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
    case EditKind::rename:
      set_name(scene, edit.node, edit.name);
      return scene;
  }
  return impossible_edit("an unknown edit");
}

Result<Scene> with_edits(Scene scene, const std::vector<StructuralEdit>& edits) {
  for (const StructuralEdit& edit : edits) {
    auto changed = with_edit(std::move(scene), edit);
    if (!changed) return changed;
    scene = std::move(*changed);
  }
  return scene;
}

std::vector<bool> reached(const Scene& scene) {
  std::vector<bool> marks(scene.nodes.size());
  for (const int root : scene.roots)
    for (const int node : subtree_of(scene, root)) marks[static_cast<size_t>(node)] = true;
  return marks;
}

Scene without_removed(const Scene& scene, const std::vector<StructuralEdit>& edits) {
  std::vector<bool> removed(scene.nodes.size());
  for (const StructuralEdit& edit : edits)
    if (edit.kind == EditKind::remove)
      for (const int node : subtree_of(scene, edit.node)) removed[static_cast<size_t>(node)] = true;
  if (std::ranges::find(removed, true) == removed.end()) return scene;
  Scene result = scene;
  const auto lights = indices_after_removal(unused(scene, removed, &Node::light, scene.lights.size()));
  const auto cameras = indices_after_removal(unused(scene, removed, &Node::camera, scene.cameras.size()));
  const auto meshes = indices_after_removal(unused(scene, removed, &Node::mesh, scene.meshes.size()));
  const auto nodes = indices_after_removal(removed);
  erase_marked(result.lights, lights);
  erase_marked(result.cameras, cameras);
  erase_marked(result.meshes, meshes);
  erase_marked(result.nodes, nodes);
  for (Node& node : result.nodes) {
    renumber(node.light, lights);
    renumber(node.camera, cameras);
    renumber(node.mesh, meshes);
    renumber(node.parent, nodes);
    renumber(node.children, nodes);
  }
  renumber(result.roots, nodes);
  renumber_references(result, nodes);
  return result;
}

}  // namespace etendue::scene
