// Lights with and without extent in a scene.
#pragma once
#include "scene/scene.h"

namespace etendue::advisor {

// True if a visible node has a point, spot or directional light.
bool has_point_lights(const scene::Scene& scene);
// True if the scene has emissive materials or an environment.
bool has_extended_lights(const scene::Scene& scene);

// The scene with its point, spot and directional lights only.
scene::Scene with_point_lights_only(const scene::Scene& scene);

}  // namespace etendue::advisor
