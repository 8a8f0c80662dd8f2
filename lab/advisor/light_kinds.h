// Lights with and without extent in a scene, and surfaces with specular lobes.
#pragma once
#include "scene/forward.h"
#include "scene/scene.h"

namespace etendue::advisor {

// True if a visible node has a point, spot or directional light.
bool has_point_lights(const scene::Scene& scene);
// True if the scene has emissive materials or an environment.
bool has_extended_lights(const scene::Scene& scene);

// The scene with its point, spot and directional lights only.
scene::Scene with_point_lights_only(const scene::Scene& scene);

// True if a visible surface is a mirror or clear glass, or has a smooth layer: paths may have specular vertices (S).
bool has_specular_surfaces(const scene::CompiledScene& scene);

}  // namespace etendue::advisor
