#include "advisor/light_kinds.h"

#include <algorithm>

#include "scene/compiled_scene.h"

namespace etendue::advisor {

bool has_point_lights(const scene::Scene& scene) {
  return std::ranges::any_of(scene.nodes, [&](const scene::Node& node) {
    return node.visible && node.light >= 0 && scene.lights[static_cast<size_t>(node.light)].intensity() > 0;
  });
}

bool has_extended_lights(const scene::Scene& scene) {
  return !scene.environment.black() ||
         std::ranges::any_of(scene.materials, [](const Material& m) { return m.is_emissive() || m.unlit; });
}

scene::Scene with_point_lights_only(const scene::Scene& scene) {
  scene::Scene lit = scene;
  lit.environment.tint = Rgb(0);
  for (Material& m : lit.materials) {
    m.emission = Rgb(0);
    if (!m.unlit) continue;
    // An unlit surface reflects nothing.
    m.unlit = false;
    m.base_color = Rgb(0);
    m.metallic = 0;
    m.transmission = 0;
    m.specular = 0;
  }
  return lit;
}

bool has_specular_surfaces(const scene::CompiledScene& scene) {
  return std::ranges::any_of(
      scene.instances(), [&](const auto& instance) { return scene.materials()[instance.material].has_delta_lobes; });
}

}  // namespace etendue::advisor
