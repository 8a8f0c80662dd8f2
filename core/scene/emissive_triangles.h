// The area lights of instances.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "light/sampling/light_table.h"
#include "scene/compiled_scene.h"

namespace etendue::scene {

// Appends the lights of an instance. Triangles on which an emission texture is black at all points of its mean are left
// out; the result states which, and is null if there are none.
std::shared_ptr<const EmittingTriangles> add_emissive(const InstanceData& instance, const SurfaceMaterial& material,
                                                      std::vector<AreaLightTriangle>& triangles);

// Appends the lights of an instance that emits as before at another place. `known` are those of the previous scene.
void add_moved(const InstanceData& instance, const SurfaceMaterial& material, std::span<const AreaLightTriangle> known,
               std::vector<AreaLightTriangle>& triangles);

// The light of an instance with an analytic shape, which is appended to `round_lights`.
AreaLightTriangle emissive_round(const InstanceData& instance, const SurfaceMaterial& material,
                                 std::vector<AnalyticAreaLight>& round_lights);

}  // namespace etendue::scene
