// Emission from a point: what point and spot lights share.                                  KHR_lights_punctual
#pragma once
#include "light/light_place.h"
#include "light/light_type.h"
#include "light/sampling/emission.h"
#include "light/sampling/light_bounds.h"
#include "light/sampling/scene_sphere.h"

namespace etendue {

struct PunctualEmitter {
  static constexpr bool kIsInfinite = false;

  Rgb color{1};
  float intensity = 1;      // cd
  float range = kInfinity;  // m

  Rgb radiant_intensity() const { return color * intensity; }

  // The window that KHR_lights_punctual recommends: 1 - (distance / range)^4, at least 0.
  float range_window(float distance) const {
    if (!std::isfinite(range)) return 1;
    return std::clamp(1 - sqr(sqr(distance / range)), 0.0f, 1.0f);
  }

  LightBounds bounds(const LightPlace& place) const {
    LightBounds b;
    b.box.extend(place.position);
    b.intensity = intensity * luminance(color);
    b.range = range;
    return b;
  }

 protected:
  // Irradiance by the inverse-square law; false if the receiver is at the light.
  bool sample_point(const LightPlace& place, const Vec3& from, LightSample& s) const {
    s.delta = true;
    s.pdf = 1;
    const Vec3 to_light = place.position - from;
    const float distance2 = length_squared(to_light);
    if (!(distance2 > 0)) return false;
    s.distance = std::sqrt(distance2);
    s.wi = to_light / s.distance;
    s.radiance = radiant_intensity();
    s.radiance *= range_window(s.distance) / distance2;
    return true;
  }
};

// The parameter `range` of point and spot lights.
inline Number<float> range_parameter() {
  return {"range",
          "Range",
          0,
          {0, 1e9f},
          "Distance at which the light is faded out to zero (KHR_lights_punctual); 0 is unlimited",
          "m",
          Scale::logarithmic};
}
inline float range_or_infinity(float range) { return range > 0 ? range : kInfinity; }

}  // namespace etendue
