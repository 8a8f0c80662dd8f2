// Lights that rays meet: the shape and the material of quads, disks and spheres.
#pragma once
#include <memory>

#include "geometry/analytic_shape.h"
#include "light/light.h"
#include "material/material.h"

namespace etendue::scene {

// A surface that stands for points is not there.
inline bool is_met_by_rays(const Light& light) { return light.is_surface() && light.points == 0; }

// At the origin, facing -z: a quad, or a mesh as large as a round light.
std::shared_ptr<const Mesh> stand_in(const Light& light);
AnalyticShape shape_of(const Light& light);
// Black, and as bright as the light on its sides.
Material material_of(const Light& light);

using etendue::without_scale;
std::shared_ptr<const Motion> without_scale(const Motion& motion);

}  // namespace etendue::scene
