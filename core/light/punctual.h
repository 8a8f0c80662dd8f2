// How the light of punctual lights falls off.                                         KHR_lights_punctual
#pragma once
#include "light/light.h"

namespace etendue {

// What is left of the intensity on the axis. Between the cosines of the two cones this is the falloff that
// KHR_lights_punctual recommends, or one that begins and ends without a kink, or ends more softly; or a power of the
// cosine.
inline float spot_falloff(const Light& light, float cosine) {
  const float outer = std::cos(light.outer_cone);
  if (light.profile == SpotProfile::cosine)
    return cosine > outer ? std::pow(std::max(cosine, 0.0f), light.exponent) : 0;
  const float scale = 1 / std::max(0.001f, std::cos(light.inner_cone) - outer);
  const float t = std::clamp((cosine - outer) * scale, 0.0f, 1.0f);
  switch (light.profile) {
    case SpotProfile::smoothstep:
      return t * t * (3 - 2 * t);
    case SpotProfile::quartic:
      return sqr(sqr(t));
    default:
      return sqr(t);
  }
}

// The window that KHR_lights_punctual recommends for a light with a range.
inline float range_window(const Light& light, float distance) {
  if (!std::isfinite(light.range)) return 1;
  return std::clamp(1 - sqr(sqr(distance / light.range)), 0.0f, 1.0f);
}

}  // namespace etendue
