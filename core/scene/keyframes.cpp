#include "scene/keyframes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "scene/pose.h"
#include "scene/rotation.h"

namespace etendue::scene {
namespace {

constexpr std::array kPaths{AnimatedPath::translation, AnimatedPath::rotation, AnimatedPath::scale};

bool is_same_time(float a, float b) { return std::abs(a - b) <= kKeyframeTolerance; }

size_t components_of(AnimatedPath path) { return path == AnimatedPath::rotation ? 4 : 3; }

std::array<float, 4> value_of(const Transform& t, AnimatedPath path) {
  if (path == AnimatedPath::rotation) return {t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w};
  const Vec3& v = path == AnimatedPath::translation ? t.translation : t.scale;
  return {v.x, v.y, v.z, 0};
}

// A quaternion and its negative are the same rotation; interpolation takes the shorter way between values.
void set_key(AnimationChannel& channel, float time, std::span<const float> value) {
  const auto at = std::ranges::find_if(channel.times, [&](float t) { return t >= time - kKeyframeTolerance; });
  const auto index = static_cast<size_t>(at - channel.times.begin());
  const auto values = channel.values.begin() + static_cast<std::ptrdiff_t>(index * channel.components);
  if (at != channel.times.end() && is_same_time(*at, time)) {
    std::ranges::copy(value, values);
    return;
  }
  channel.times.insert(at, time);
  channel.values.insert(values, value.begin(), value.end());
}

void remove_key(AnimationChannel& channel, float time) {
  const auto at = std::ranges::find_if(channel.times, [&](float t) { return is_same_time(t, time); });
  if (at == channel.times.end()) return;
  const auto values =
      channel.values.begin() + (at - channel.times.begin()) * static_cast<std::ptrdiff_t>(channel.components);
  channel.values.erase(values, values + static_cast<std::ptrdiff_t>(channel.components));
  channel.times.erase(at);
}

// The channel of a path; a new one has no keys. With one key, its value is that of all times.
AnimationChannel& channel_of(Animation& animation, int node, AnimatedPath path) {
  for (AnimationChannel& channel : animation.channels)
    if (channel.node == node && channel.path == path) return channel;
  return animation.channels.emplace_back(
      AnimationChannel{.node = node, .path = path, .times = {}, .values = {}, .components = components_of(path)});
}

float duration_of(const Animation& animation) {
  float duration = 0;
  for (const AnimationChannel& channel : animation.channels)
    if (!channel.times.empty()) duration = std::max(duration, channel.times.back());
  return duration;
}

void replace(Scene& scene, int index, Animation animation) {
  animation.duration = duration_of(animation);
  scene.animations[static_cast<size_t>(index)] = std::make_shared<const Animation>(std::move(animation));
}

bool has_animation(const Scene& scene, int animation) {
  return animation >= 0 && static_cast<size_t>(animation) < scene.animations.size();
}

Error unknown_animation(int animation) {
  return usage_error("the scene has no animation " + std::to_string(animation));
}

}  // namespace

std::string keyframe_obstacle(const Scene& scene, int node) {
  if (node < 0 || static_cast<size_t>(node) >= scene.nodes.size()) return "The scene does not have this object";
  const Node& n = scene.nodes[static_cast<size_t>(node)];
  if (n.skin >= 0) return "The joints of a skin place this object";
  if (!decompose(n.transform)) return "The transform of this object shears it, which keyframes cannot describe";
  bool is_curved = false;
  for_each_channel(scene, [&](const AnimationChannel& channel) {
    is_curved |= is_transform_channel(channel, node) && channel.interpolation != Interpolation::linear;
  });
  return is_curved ? "The animation of this object has steps or curves; only linear ones can be edited" : "";
}

int animation_for_keyframes(const Scene& scene, int node) {
  if (has_animation(scene, scene.clip)) return scene.clip;
  const std::vector<size_t> playing = playing_animations(scene);
  for (const size_t i : playing) {
    const auto& channels = scene.animations[i]->channels;
    if (std::ranges::any_of(channels, [&](const auto& c) { return is_transform_channel(c, node); }))
      return static_cast<int>(i);
  }
  return playing.empty() ? -1 : static_cast<int>(playing.front());
}

std::vector<float> keyframe_times(const Scene& scene, int node, int animation) {
  std::set<float> times;
  if (has_animation(scene, animation))
    for (const AnimationChannel& channel : scene.animations[static_cast<size_t>(animation)]->channels)
      if (is_transform_channel(channel, node)) times.insert(channel.times.begin(), channel.times.end());
  return {times.begin(), times.end()};
}

Result<Scene> with_keyframe(Scene scene, int node, int animation, float time, const Transform& transform) {
  if (scene.nodes[static_cast<size_t>(node)].skin >= 0) return usage_error("the joints of a skin place this object");
  if (!(time >= 0 && time <= kLongestAnimation)) return usage_error("the time of a keyframe is between 0 and 10000 s");
  if (transform.matrix) return usage_error("a keyframe has a translation, a rotation and a scale, not a matrix");
  if (animation == -1) {
    animation = static_cast<int>(scene.animations.size());
    scene.animations.push_back(std::make_shared<const Animation>(Animation{.name = "Animation", .channels = {}}));
  }
  if (!has_animation(scene, animation)) return unknown_animation(animation);
  Animation changed = *scene.animations[static_cast<size_t>(animation)];
  for (const AnimatedPath path : kPaths) {
    AnimationChannel& channel = channel_of(changed, node, path);
    if (channel.interpolation != Interpolation::linear)
      return usage_error("the animation of this object has steps or curves; only linear ones can be edited");
    const auto value = value_of(transform, path);
    set_key(channel, time, std::span(value).first(channel.components));
  }
  replace(scene, animation, std::move(changed));
  return scene;
}

Result<Scene> without_keyframe(Scene scene, int node, int animation, float time) {
  if (!has_animation(scene, animation)) return unknown_animation(animation);
  const std::vector<float> times = keyframe_times(scene, node, animation);
  if (std::ranges::none_of(times, [&](float t) { return is_same_time(t, time); }))
    return usage_error("the object has no keyframe at this time");
  Animation changed = *scene.animations[static_cast<size_t>(animation)];
  for (AnimationChannel& channel : changed.channels) {
    if (!is_transform_channel(channel, node)) continue;
    if (channel.interpolation != Interpolation::linear)
      return usage_error("the animation of this object has steps or curves; only linear ones can be edited");
    remove_key(channel, time);
  }
  std::erase_if(changed.channels, [](const AnimationChannel& channel) { return channel.times.empty(); });
  replace(scene, animation, std::move(changed));
  return scene;
}

}  // namespace etendue::scene
