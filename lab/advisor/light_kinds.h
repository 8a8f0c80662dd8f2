// Which kinds of light a scene has, and the scene with one of them alone.
#pragma once
#include "scene/scene.h"

namespace etendue::advisor {

// Point, spot and directional lights of nodes that are in the scene.
bool has_point_lights(const scene::Scene& scene);
// Surfaces that shine, or an environment.
bool has_extended_lights(const scene::Scene& scene);

// The scene lit by its lights without extent alone.
scene::Scene lit_by_points(const scene::Scene& scene);

}  // namespace etendue::advisor
