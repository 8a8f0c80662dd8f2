// Places densities in the bounding boxes of their media.
#pragma once
#include "medium/heterogeneous_medium.h"
#include "scene/compiled_scene.h"

namespace etendue::scene {

// The matrix from world space to the unit cube of the density in a solid: the bounding box of its boundary in the space
// of its node, whose world matrix is `world`.
Mat4 density_box(const InstanceArray& instances, uint32_t solid, const Mat4& world);

// The same for an axis-aligned box in world space.
Mat4 density_box(const Bounds& bounds);

// A medium with this description and further absorption at density 1, in 1/m. An error says why its density cannot be
// rendered. `moves`: while the shutter is open.
Result<std::shared_ptr<const HeterogeneousMedium>> place_density(const MediumDescription& medium, const Rgb& absorption,
                                                                 const Mat4& world_to_grid, bool moves);

}  // namespace etendue::scene
