// Geometry and materials of area lights: quads, disks and spheres.
#pragma once
#include <memory>

#include "geometry/analytic_shape.h"
#include "light/light.h"
#include "material/material.h"

namespace etendue::scene {

// Whether rays can hit the light. An area light that is replaced by point samples has no geometry.
inline bool is_met_by_rays(const Light& light) { return light.is_surface() && light.points == 0; }

// A mesh at the origin facing -z: the quad itself, or a mesh with the extent of a disk or sphere.
std::shared_ptr<const Mesh> stand_in(const Light& light);
// The analytic shape of a disk or sphere at the origin.
RoundShape shape_of(const Light& light);
// A black material that emits the radiance of the light on its emitting sides.
Material material_of(const Light& light);

// The same motion with scale removed from all its matrices.
using etendue::without_scale;
std::shared_ptr<const Motion> without_scale(const Motion& motion);

}  // namespace etendue::scene
