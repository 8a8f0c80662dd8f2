// The lights of a scene as people count them.
#pragma once
#include <cstddef>
#include <string>

#include "scene/forward.h"

namespace etendue::scene {

struct LightCounts {
  size_t lights = 0;              // visible nodes with a light
  size_t emissive_objects = 0;    // other visible nodes with an emissive surface
  size_t emissive_triangles = 0;  // of all emissive meshes
  bool environment = false;       // that emits

  size_t total() const { return lights + emissive_objects + (environment ? 1 : 0); }
};
LightCounts count_lights(const CompiledScene& scene);

// "3 emissive objects (48384 triangles)", "2 lights, environment", or "none".
std::string light_text(const LightCounts& counts);

}  // namespace etendue::scene
