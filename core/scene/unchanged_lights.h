// Which parts of the lighting an edit of a scene leaves as they were, so that the light table can be reused.
#pragma once
#include <vector>

#include "scene/compiled_scene.h"

namespace etendue::scene {

// Whether the materials emit the same light.
bool same_emission(const Scene& a, const Scene& b);

// Whether two instances are the same surface at the same place. False if they move while the shutter is open.
bool same_surface(const InstanceData& a, const InstanceData& b);

// Whether the same instances emit, at the same places. `materials` are those of both. The light indices of the
// instances `old` must be set.
bool same_emitters(const InstanceArray& now, const InstanceArray& old, const std::vector<SurfaceMaterial>& materials);

// Whether all nodes with lights are visible as before, at the same places and in the same order. False for animated scenes.
bool same_light_places(const Scene& a, const Scene& b);

// Whether textures have the same values at the same triangles of both meshes.
bool same_parametrization(const Mesh& a, const Mesh& b);

// Whether a surface of this material is an area light.
bool is_area_light(const SurfaceMaterial& material);

}  // namespace etendue::scene
