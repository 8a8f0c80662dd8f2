// Keyframes that the user sets: the translation, rotation and scale of a node at a time.
//
// They are linear channels of an animation, like those of glTF files, so that files keep them.
#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

// Why a node cannot have keyframes, as a sentence without a full stop; empty if it can.
std::string keyframe_obstacle(const Scene& scene, int node);

// The animation that receives a new keyframe of a node: the selected clip, otherwise one that plays; -1 if the scene has
// none, so that one is to be added.
int animation_for_keyframes(const Scene& scene, int node);

// The times of the keyframes of a node in an animation, increasing, in seconds; none for index -1.
std::vector<float> keyframe_times(const Scene& scene, int node, int animation);

// The scene with a keyframe; one at the same time is replaced. Index -1 adds an animation. Node and time must be valid.
Result<Scene> with_keyframe(Scene scene, int node, int animation, float time, const Transform& transform);
// The scene without the keyframe of a node at this time. The last one takes the channels with it.
Result<Scene> without_keyframe(Scene scene, int node, int animation, float time);

// Keyframes nearer to each other are at the same time, in seconds.
inline constexpr float kKeyframeTolerance = 1e-4f;
inline constexpr float kLongestAnimation = 1e4f;  // seconds

}  // namespace etendue::scene
