// Interpolates the keyframes of an animation channel.                         glTF 2.0, appendix C
#pragma once
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace etendue::scene {

// Writes `channel.components` numbers for `time` in seconds. Before the first and after the last keyframe the value is
// constant. Rotations use spherical linear interpolation and are unit quaternions (x y z w).
void sample_channel(const AnimationChannel& channel, float time, std::span<float> out);

// The duration in seconds of the clip of a scene, or of its longest animation if it names none; 0 without animations.
float animation_duration(const Scene& scene);

// Distinct names of the choices of Scene::clip: "all" for -1, then the animations in their order.
std::vector<std::string> clip_labels(const Scene& scene);

}  // namespace etendue::scene
