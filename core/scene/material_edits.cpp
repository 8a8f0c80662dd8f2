#include "scene/material_edits.h"

#include <algorithm>

#include "base/file.h"
#include "scene/builtin/shapes.h"

namespace etendue::scene {
namespace {

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

}  // namespace

Material new_material(const std::string& name) {
  constexpr float kAlbedo = 0.7f;
  Material material = diffuse(Rgb(kAlbedo));
  material.name = name;
  return material;
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

Result<Scene> with_material_edit(Scene scene, const StructuralEdit& edit) {
  if (edit.kind == EditKind::add_material) return with_material(std::move(scene), edit);
  if (edit.kind == EditKind::add_texture) return with_texture(std::move(scene), edit);
  if (!has_material(scene, edit.material)) return unknown_material(edit.material);
  if (edit.kind == EditKind::remove_material) return without_material(std::move(scene), edit);
  if (edit.kind == EditKind::assign_material) return with_assigned_material(std::move(scene), edit);
  scene.materials[static_cast<size_t>(edit.material)].name = edit.name;
  return scene;
}

}  // namespace etendue::scene
