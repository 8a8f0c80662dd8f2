// Point light: the same intensity in every direction.                        [Lang, eq. 4.366;
// KHR_lights_punctual]
//
//   E = I cos(theta) / r^2,    Phi = 4 pi I
#pragma once
#include "light/types/punctual_emitter.h"

namespace etendue {

struct PointLight {
  static constexpr LightTypeDescription kDescription{
      .name = "point",
      .label = "Point light",
      .summary = "The same intensity in every direction, from a point",
      .light_class = LightClass::delta_position,
      .quantity = &kLuminousIntensity,
      .formula = "E = I cos / r^2",
      .sampling = "its position; rays that leave it are uniform over the sphere",
      .source = "[Lang, eq. 4.366]; KHR_lights_punctual",
      .punctual = true,
  };

  Number<float> intensity = intensity_parameter(kLuminousIntensity, "Luminous intensity, the same in every direction");
  Number<float> range = range_parameter();
  auto parameters() { return std::tie(intensity, range); }

  struct Emitter : PunctualEmitter {
    Rgb flux() const { return color * (4 * kPi * intensity); }
    float power(float) const { return luminance(flux()); }

    bool sample(const LightPlace& place, const Vec3& from, Vec2, LightSample& s) const {
      return sample_point(place, from, s) && !is_black(s.radiance);
    }

    Rgb emitted(const LightPlace&, const Vec3&, float distance) const {
      return radiant_intensity() * range_window(distance);
    }
    EmissionDensity emission_density(const SceneSphere&) const { return {1, 1 / (4 * kPi), true, false}; }
    void sample_emission(const LightPlace& place, const SceneSphere& scene, const EmissionRandom& random,
                         Emission& e) const {
      e.position = place.position;
      resample_emission(place, scene, random.direction, e);
    }
    void resample_emission(const LightPlace&, const SceneSphere&, Vec2 u, Emission& e) const {
      e.radiance = radiant_intensity();
      e.direction = square_to_sphere(u);
    }
  };
  Emitter emitter(const Rgb& color) const { return {{color, intensity, range_or_infinity(range)}}; }
};

}  // namespace etendue
