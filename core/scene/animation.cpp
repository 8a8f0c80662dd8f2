#include "scene/animation.h"

#include <algorithm>

namespace etendue::scene {
namespace {

Vec4 slerp(const Vec4& a, Vec4 b, float t) {
  float cosine = glm::dot(a, b);
  if (cosine < 0) {
    b = -b;
    cosine = -cosine;
  }
  if (cosine > 0.9995f) return glm::normalize(glm::mix(a, b, t));
  const float angle = std::acos(cosine);
  return (a * std::sin((1 - t) * angle) + b * std::sin(t * angle)) / std::sin(angle);
}

Vec4 quaternion(const float* v) { return Vec4(v[0], v[1], v[2], v[3]); }

}  // namespace

void sample_channel(const AnimationChannel& channel, float time, std::span<float> out) {
  const size_t n = channel.components;
  const bool cubic = channel.interpolation == Interpolation::cubic;
  const auto key = [&](size_t k) { return &channel.values[(cubic ? 3 * k + 1 : k) * n]; };
  const auto& times = channel.times;
  const auto above = static_cast<size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (above == 0 || above == times.size()) {
    std::copy_n(key(above == 0 ? 0 : times.size() - 1), n, out.begin());
    return;
  }
  const size_t k = above - 1;
  const float span = times[k + 1] - times[k], t = (time - times[k]) / span;
  const bool rotation = channel.path == AnimatedPath::rotation;
  if (channel.interpolation == Interpolation::step) {
    std::copy_n(key(k), n, out.begin());
  } else if (cubic) {
    // Cubic Hermite spline with the out-tangent of this keyframe and the in-tangent of the next.
    const float t2 = t * t, t3 = t2 * t;
    const float* out_tangent = &channel.values[(3 * k + 2) * n];
    const float* in_tangent = &channel.values[(3 * (k + 1)) * n];
    for (size_t c = 0; c < n; ++c)
      out[c] = (2 * t3 - 3 * t2 + 1) * key(k)[c] + span * (t3 - 2 * t2 + t) * out_tangent[c] +
               (-2 * t3 + 3 * t2) * key(k + 1)[c] + span * (t3 - t2) * in_tangent[c];
  } else if (rotation) {
    const Vec4 q = slerp(quaternion(key(k)), quaternion(key(k + 1)), t);
    for (size_t c = 0; c < 4; ++c) out[c] = q[static_cast<int>(c)];
  } else {
    for (size_t c = 0; c < n; ++c) out[c] = key(k)[c] * (1 - t) + key(k + 1)[c] * t;
  }
  if (rotation && cubic) {
    const Vec4 q = quaternion(out.data());
    const float length = glm::length(q);
    for (size_t c = 0; c < 4; ++c) out[c] = length > 0 ? out[c] / length : (c == 3 ? 1.0f : 0.0f);
  }
}

float animation_duration(const Scene& scene) {
  if (scene.clip >= 0 && static_cast<size_t>(scene.clip) < scene.animations.size())
    return scene.animations[static_cast<size_t>(scene.clip)]->duration;
  float duration = 0;
  for (const auto& animation : scene.animations) duration = std::max(duration, animation->duration);
  return duration;
}

std::vector<std::string> clip_labels(const Scene& scene) {
  std::vector<std::string> labels{"all"};
  for (const auto& animation : scene.animations) {
    const std::string name = animation->name.empty() ? "clip" : animation->name;
    std::string label = name;
    for (int n = 2; std::ranges::count(labels, label) > 0; ++n) label = name + " " + std::to_string(n);
    labels.push_back(std::move(label));
  }
  return labels;
}

}  // namespace etendue::scene
