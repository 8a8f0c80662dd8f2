// The bounds of the instances that stay where they are while others move.
#pragma once
#include <span>

#include "geometry/accel.h"
#include "scene/forward.h"

namespace etendue::scene {

// The bounds of all instances of `accel` except those in `moved`, which contains those that have moved before. `instances`
// have the places that `accel` knows. Only if a place of a newly moved one may determine the bounds, the time is
// proportional to the number of instances.
Bounds bounds_of_unmoved(const Accel& accel, const InstanceArray& instances, std::span<const MovedInstance> moved);

}  // namespace etendue::scene
