// Lights with and without extent in a scene, and surfaces with specular lobes.
#pragma once
#include <algorithm>

#include "scene/compiled_scene.h"
#include "scene/scene.h"

namespace etendue::scene {

// True if a visible node has a point, spot or directional light.
inline bool has_point_lights(const Scene& scene) {
  return std::ranges::any_of(scene.nodes, [&](const Node& node) {
    return node.visible && node.light >= 0 && scene.lights[static_cast<size_t>(node.light)].intensity() > 0;
  });
}

// True if the scene has emissive materials or an environment.
inline bool has_extended_lights(const Scene& scene) {
  return !scene.environment.black() ||
         std::ranges::any_of(scene.materials, [](const Material& m) { return m.is_emissive() || m.unlit; });
}

// The scene with its point, spot and directional lights only.
inline Scene with_point_lights_only(const Scene& scene) {
  Scene lit = scene;
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

// True if a visible surface is a mirror or clear glass, or has a smooth layer: paths may have specular vertices (S).
inline bool has_specular_surfaces(const CompiledScene& scene) {
  return std::ranges::any_of(
      scene.instances(), [&](const auto& instance) { return scene.materials()[instance.material].has_delta_lobes; });
}

}  // namespace etendue::scene
