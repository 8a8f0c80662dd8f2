// What lights send out altogether, W: the one place that knows, for choosing among them and for showing it.
#pragma once
#include "light/light_table.h"

namespace etendue {

// The part of the zone between a spot's cones that its profile leaves, the mean over the cosine.
inline float share_between_cones(SpotProfile profile) {
  switch (profile) {
    case SpotProfile::smoothstep:
      return 1 / 2.0f;
    case SpotProfile::quartic:
      return 1 / 5.0f;
    default:
      return 1 / 3.0f;
  }
}

// The solid angle that would send as much with the intensity of the axis.
inline float solid_angle_of_spot(const Light& light) {
  const float outer = std::max(std::cos(light.outer_cone), 0.0f), inner = std::max(std::cos(light.inner_cone), outer);
  if (light.profile == SpotProfile::cosine)
    return 2 * kPi * (1 - std::pow(outer, light.exponent + 1)) / (light.exponent + 1);
  return 2 * kPi * (1 - inner + share_between_cones(light.profile) * (inner - outer));
}

// Of textured emission the mean.
inline Rgb flux_of(const AreaLightTriangle& t) {
  return t.radiance * (2 * kPi / (t.cosine_exponent + 2) * t.area * (t.double_sided ? 2.0f : 1.0f));
}

// Nothing of light without a place.
inline Rgb flux_of(const Light& light) {
  switch (light.type) {
    case LightType::point:
      return light.color * (4 * kPi * light.intensity);
    case LightType::spot:
      return light.color * (solid_angle_of_spot(light) * light.intensity);
    case LightType::quad:
    case LightType::disk:
    case LightType::sphere:
      return light.radiance() *
             (2 * kPi / (light.cosine_exponent + 2) * light.area() * static_cast<float>(light.sides()));
    default:
      return Rgb(0);
  }
}

}  // namespace etendue
