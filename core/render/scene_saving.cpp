#include "render/scene_saving.h"

#include "render/default_light.h"
#include "scene/pose.h"

namespace etendue::render {
namespace {

constexpr const char* kViewName = "view";

// The node of the camera "view" of an earlier save, or a new one before all other roots.
scene::Node& view_node(scene::Scene& scene) {
  for (scene::Node& node : scene.nodes)
    if (node.camera >= 0 && node.name == kViewName && node.parent < 0 && node.transform.matrix) return node;
  scene.roots.insert(scene.roots.begin(), static_cast<int>(scene.nodes.size()));
  scene::Node& node = scene.nodes.emplace_back();
  node.name = kViewName;
  node.camera = static_cast<int>(scene.cameras.size());
  scene.cameras.emplace_back().name = kViewName;
  return node;
}

// Replaces the camera of a node. The name stays, and the transform is that of the node.
void replace_camera(scene::Scene& scene, const scene::Node& node, const Camera& camera) {
  Camera& replaced = scene.cameras[static_cast<size_t>(node.camera)];
  const std::string name = replaced.name;
  replaced = camera;
  replaced.name = name;
  replaced.to_world = Mat4(1);
}

}  // namespace

scene::Scene scene_to_save(const Document& document) {
  scene::Scene scene = scene::without_removed(*document.scene, document.structure);
  if (document.lit_by_default && scene.environment == default_environment()) scene.environment = Environment{};
  const int node = scene::node_of_camera(scene, document.camera);
  if (node >= 0) {
    replace_camera(scene, scene.nodes[static_cast<size_t>(node)], document.camera);
    return scene;
  }
  // A camera that was placed automatically to frame the scene will be placed again when the file is opened.
  if (document.origin && document.camera == document.origin->camera) return scene;
  scene::Node& view = view_node(scene);
  view.transform.matrix = document.camera.to_world;
  replace_camera(scene, view, document.camera);
  return scene;
}

}  // namespace etendue::render
