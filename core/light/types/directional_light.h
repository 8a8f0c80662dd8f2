// Directional light: a parallel beam from infinity.                        [Lang, eq. 4.374, corrected;
// KHR_lights_punctual]
//
//   E = E_b cos(theta),    E_b the irradiance of a surface that faces the beam
#pragma once
#include "light/light_place.h"
#include "light/light_type.h"
#include "light/sampling/emission.h"
#include "light/sampling/scene_sphere.h"

namespace etendue {

struct DirectionalLight {
  static constexpr LightTypeDescription kDescription{
      .name = "directional",
      .label = "Directional light",
      .summary = "A parallel beam from infinity, like that of the sun",
      .light_class = LightClass::delta_direction,
      .quantity = &kIlluminance,
      .formula = "E = E_b cos, with the irradiance E_b of a surface that faces the beam",
      .sampling = "its direction; rays that leave it are uniform over a disk that covers the scene",
      .source = "[Lang, eq. 4.374, corrected]; KHR_lights_punctual",
      .punctual = true,
  };

  Number<float> intensity = intensity_parameter(kIlluminance, "Illuminance of a surface that faces the light");
  auto parameters() { return std::tie(intensity); }

  struct Emitter {
    static constexpr bool kIsInfinite = true;

    Rgb color{1};
    float irradiance = 1;  // lx

    Rgb flux() const { return Rgb(0); }
    float power(float scene_radius) const { return kPi * sqr(scene_radius) * (luminance(color) * irradiance); }
    float range_window(float) const { return 1; }

    bool sample(const LightPlace& place, const Vec3&, Vec2, LightSample& s) const {
      s.delta = true;
      s.pdf = 1;
      s.wi = -place.direction;
      s.distance = kInfinity;
      s.radiance = color * irradiance;
      return true;
    }

    Rgb emitted(const LightPlace&, const Vec3&, float) const { return color * irradiance; }
    EmissionDensity emission_density(const SceneSphere& scene) const { return {1, scene.entry_pdf(), true, true}; }
    void sample_emission(const LightPlace& place, const SceneSphere& scene, const EmissionRandom& random,
                         Emission& e) const {
      e.direction = place.direction;
      e.radiance = color * irradiance;
      resample_emission(place, scene, random.point, e);
    }
    void resample_emission(const LightPlace&, const SceneSphere& scene, Vec2 u, Emission& e) const {
      e.position = scene.entry_point(e.direction, u);
    }
  };
  Emitter emitter(const Rgb& color) const { return {color, intensity}; }
};

}  // namespace etendue
