// The value of an animated property at a moment.                              glTF 2.0, appendix C
#pragma once
#include <span>

#include "scene/scene.h"

namespace etendue::scene {

// Writes `channel.components` numbers. Before the first key and after the last the nearest one holds. Rotations are
// interpolated on the sphere and come out as unit quaternions (x y z w).
void sample_channel(const AnimationChannel& channel, float time, std::span<float> out);

}  // namespace etendue::scene
