#include "viewer/state/node_places.h"

#include "scene/scene.h"
#include "scene/structural_edit.h"

namespace etendue::viewer {

const NodePlaces::Places& NodePlaces::of(const std::shared_ptr<const scene::Scene>& scene) const {
  if (scene == scene_) return places_;
  scene_ = scene;
  places_ = {.world = scene::world_matrices(*scene), .exists = scene::reached(*scene), .lights = {}, .with_icon = {}};
  for (size_t i = 0; i < scene->nodes.size(); ++i) {
    const scene::Node& node = scene->nodes[i];
    if (!places_.exists[i]) continue;
    if (node.light >= 0) places_.lights.push_back(static_cast<int>(i));
    if (node.light >= 0 || node.camera >= 0) places_.with_icon.push_back(static_cast<int>(i));
  }
  return places_;
}

}  // namespace etendue::viewer
