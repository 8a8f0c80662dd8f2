#include "render/scene_saving.h"

#include "scene/pose.h"

namespace etendue::render {
namespace {

constexpr const char* kView = "view";

bool is_neutral(const Environment& environment) {
  Environment neutral;
  neutral.tint = Rgb(1);
  return environment == neutral;
}

// The node of an earlier view, or a new one before all others.
scene::Node& node_of_view(scene::Scene& scene) {
  for (scene::Node& node : scene.nodes)
    if (node.camera >= 0 && node.name == kView && node.parent < 0 && node.transform.matrix) return node;
  scene.roots.insert(scene.roots.begin(), static_cast<int>(scene.nodes.size()));
  scene::Node& node = scene.nodes.emplace_back();
  node.name = kView;
  node.camera = static_cast<int>(scene.cameras.size());
  scene.cameras.emplace_back().name = kView;
  return node;
}

void put_camera(scene::Scene& scene, const scene::Node& node, const Camera& camera) {
  Camera& kept = scene.cameras[static_cast<size_t>(node.camera)];
  const std::string name = kept.name;
  kept = camera;
  kept.name = name, kept.to_world = Mat4(1);
}

}  // namespace

scene::Scene scene_to_save(const Document& document) {
  scene::Scene scene = *document.scene;
  if (document.lit_by_default && is_neutral(scene.environment)) scene.environment = Environment{};
  const int node = scene::node_of_camera(scene, document.camera);
  if (node >= 0) {
    put_camera(scene, scene.nodes[static_cast<size_t>(node)], document.camera);
    return scene;
  }
  // A camera that only frames what there is would be made again.
  if (document.origin && document.camera == document.origin->camera) return scene;
  scene::Node& view = node_of_view(scene);
  view.transform.matrix = document.camera.to_world;
  put_camera(scene, view, document.camera);
  return scene;
}

}  // namespace etendue::render
