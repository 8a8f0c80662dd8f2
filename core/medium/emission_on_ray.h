// The light that a heterogeneous medium emits along a ray, estimated at a point of every voxel.    [Simon et al. 2017]
#pragma once
#include "medium/heterogeneous_medium.h"

namespace etendue {

// The transmittance of a span without error. `emitted` is the radiance that reaches its start, estimated without bias
// at one random point of every voxel on the ray. It has much less variance than estimates at collisions, and its cost
// is that of all voxels on the ray.
template <class Color>
Color transmittance_and_emission_by_voxels(const HeterogeneousMedium& medium,
                                           const HeterogeneousCoefficients<Color>& coefficients, const RaySpan& span,
                                           RandomStream& random, Color& emitted);

}  // namespace etendue
