// Interpolates the keyframes of an animation channel.                         glTF 2.0, appendix C
#pragma once
#include <span>

#include "scene/scene.h"

namespace etendue::scene {

// Writes `channel.components` numbers for `time` in seconds. Before the first and after the last keyframe the value is
// constant. Rotations use spherical linear interpolation and are unit quaternions (x y z w).
void sample_channel(const AnimationChannel& channel, float time, std::span<float> out);

// The duration in seconds of the longest animation of a scene; 0 if it has none.
float animation_duration(const Scene& scene);

}  // namespace etendue::scene
