// Removes from a scene what its edits have removed, before it is saved.
#include <algorithm>

#include "material/texture_slots.h"
#include "scene/structural_edit.h"

namespace etendue::scene {
namespace {

// New indices of the elements that stay, -1 for the others.
std::vector<int> indices_after_removal(const std::vector<bool>& is_removed) {
  std::vector<int> indices;
  int next = 0;
  for (const bool removed : is_removed) indices.push_back(removed ? -1 : next++);
  return indices;
}

// `values` is a std::vector or a SharedArray.
template <class Array>
void erase_marked(Array& values, const std::vector<int>& indices) {
  size_t kept = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    if (indices[i] < 0) continue;
    if (i != kept) values[kept] = std::move(values[i]);
    ++kept;
  }
  values.resize(kept);
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

void renumber_joints_and_channels(Scene& scene, const std::vector<int>& nodes) {
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

void remove_nodes(Scene& scene, const std::vector<bool>& removed) {
  const auto lights = indices_after_removal(unused(scene, removed, &Node::light, scene.lights.size()));
  const auto cameras = indices_after_removal(unused(scene, removed, &Node::camera, scene.cameras.size()));
  const auto meshes = indices_after_removal(unused(scene, removed, &Node::mesh, scene.meshes.size()));
  const auto nodes = indices_after_removal(removed);
  erase_marked(scene.lights, lights);
  erase_marked(scene.cameras, cameras);
  erase_marked(scene.meshes, meshes);
  erase_marked(scene.nodes, nodes);
  for (Node& node : scene.nodes) {
    renumber(node.light, lights);
    renumber(node.camera, cameras);
    renumber(node.mesh, meshes);
    renumber(node.parent, nodes);
    renumber(node.children, nodes);
  }
  renumber(scene.roots, nodes);
  renumber_joints_and_channels(scene, nodes);
}

// Meshes that no node shows may use a removed material; they get the first one.
void remove_materials(Scene& scene) {
  std::vector<bool> removed(scene.materials.size());
  for (const int material : scene.removed_materials) removed[static_cast<size_t>(material)] = true;
  const auto indices = indices_after_removal(removed);
  erase_marked(scene.materials, indices);
  scene.removed_materials.clear();
  const auto renumber_material = [&](int& index) { index = std::max(indices[static_cast<size_t>(index)], 0); };
  for (MeshGroup& mesh : scene.meshes)
    for (Primitive& primitive : mesh.primitives) {
      renumber_material(primitive.material);
      for (int& choice : primitive.choices) renumber_material(choice);
    }
}

// Added textures are the last ones of the scene.
void remove_unused_textures(Scene& scene, size_t added) {
  std::vector<bool> removed(scene.textures.size());
  std::fill(removed.end() - static_cast<ptrdiff_t>(added), removed.end(), true);
  const auto for_each_use = [&](const auto& apply) {
    for (Material& material : scene.materials)
      for (const TextureSlot& slot : texture_slots())
        if (int& texture = (material.*slot.use).texture; texture >= 0) apply(texture);
  };
  for_each_use([&](int texture) { removed[static_cast<size_t>(texture)] = false; });
  const auto indices = indices_after_removal(removed);
  erase_marked(scene.textures, indices);
  for_each_use([&](int& texture) { texture = indices[static_cast<size_t>(texture)]; });
}

}  // namespace

Scene without_removed(const Scene& scene, const std::vector<StructuralEdit>& edits) {
  std::vector<bool> removed(scene.nodes.size());
  for (const StructuralEdit& edit : edits)
    if (edit.kind == EditKind::remove)
      for (const int node : subtree_of(scene, edit.node)) removed[static_cast<size_t>(node)] = true;
  Scene result = scene;
  if (std::ranges::find(removed, true) != removed.end()) remove_nodes(result, removed);
  if (!scene.removed_materials.empty()) remove_materials(result);
  const auto added = std::ranges::count(edits, EditKind::add_texture, &StructuralEdit::kind);
  if (added > 0) remove_unused_textures(result, static_cast<size_t>(added));
  return result;
}

}  // namespace etendue::scene
