// The geometry and the material of area lights.
#pragma once
#include <memory>

#include "light/area_light.h"
#include "light/light.h"
#include "material/material.h"

namespace etendue::scene {

// Rays hit the surface of an area light, unless point samples replace it.
bool is_hit_by_rays(const Light& light);

// The mesh of an area light, at the origin, facing -z. Of an analytic shape, which Embree intersects without a
// mesh, a mesh of the same bounds.
std::shared_ptr<const Mesh> mesh_of(const AreaLight& light);
// The analytic shape of an area light at a node; null if its shape is a mesh.
std::shared_ptr<const AnalyticShape> analytic_shape_of(const AreaLight& light, const Mat4& to_world);
// A black surface that emits on the sides of the light; of a light that rays do not hit, one that does not emit.
Material material_of(const Light& light);

// The same motion with scale removed from all its matrices.
using etendue::without_scale;
std::shared_ptr<const Motion> without_scale(const Motion& motion);

}  // namespace etendue::scene
