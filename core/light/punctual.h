// How the light of punctual lights falls off.                                         KHR_lights_punctual
#pragma once
#include "light/light.h"

namespace etendue {

// The falloff that KHR_lights_punctual recommends, between the cosines of the two cones.
inline float spot_falloff(const Light& light, float cosine) {
  const float outer = std::cos(light.outer_cone);
  const float scale = 1 / std::max(0.001f, std::cos(light.inner_cone) - outer);
  return sqr(std::clamp((cosine - outer) * scale, 0.0f, 1.0f));
}

// The window that KHR_lights_punctual recommends for a light with a range.
inline float range_window(const Light& light, float distance) {
  if (!std::isfinite(light.range)) return 1;
  return std::clamp(1 - sqr(sqr(distance / light.range)), 0.0f, 1.0f);
}

}  // namespace etendue
