// A low sun in a clear sky: a picture, not a model of the atmosphere.
#pragma once
#include <algorithm>
#include <cmath>

#include "light/environments/builtin_environment.h"

namespace etendue {

inline Rgb sunset_radiance(const Vec3& direction) {
  const Vec3 sun = glm::normalize(Vec3(-0.8f, 0.22f, 0.55f));
  if (direction.y < 0) return Rgb(0.16f, 0.12f, 0.1f);
  const float to_zenith = std::sqrt(direction.y);
  const Rgb sky = Rgb(0.95f, 0.52f, 0.26f) * (1 - to_zenith) + Rgb(0.16f, 0.26f, 0.48f) * to_zenith;
  const float angle = std::acos(std::clamp(glm::dot(direction, sun), -1.0f, 1.0f));
  constexpr float kSunRadius = 0.026f;  // radians; soft, and larger than the real one
  const float disk = std::clamp((1.25f * kSunRadius - angle) / (0.5f * kSunRadius), 0.0f, 1.0f);
  const Rgb glow = Rgb(2.2f, 1.15f, 0.45f) * std::exp(-angle * angle / 0.08f);
  return sky * 0.7f + glow + Rgb(900, 560, 270) * disk;
}

constexpr BuiltinEnvironment kSunset{.name = "sunset",
                                     .label = "Sunset",
                                     .doc = "A low warm sun with long shadows, and a blue sky",
                                     .radiance = sunset_radiance};

}  // namespace etendue
