// Ambient light: the same radiance from every direction, which nothing blocks.                    [Lang,
// Definition 4.36]
//
//   E = pi L,    L_o = albedo L for a Lambertian surface
//
// It has no physical counterpart; it replaces indirect light. Only sampling lights finds it: no ray leaves it and no
// ray reaches it.
#pragma once
#include "light/light_place.h"
#include "light/light_type.h"
#include "light/sampling/emission.h"
#include "light/sampling/scene_sphere.h"

namespace etendue {

struct AmbientLight {
  static constexpr LightTypeDescription kDescription{
      .name = "ambient",
      .label = "Ambient light",
      .summary = "The same radiance from every direction, without shadows. Not physical; light tracing cannot find it",
      .light_class = LightClass::ambient,
      .quantity = &kLuminance,
      .formula = "E = pi L; a Lambertian surface shows albedo L",
      .sampling = "directions uniform over the sphere; no rays leave it",
      .source = "[Lang, Definition 4.36]",
  };

  Number<float> intensity =
      intensity_parameter(kLuminance, "Luminance from every direction. No physical light: it casts no shadows");
  auto parameters() { return std::tie(intensity); }

  struct Emitter {
    static constexpr bool kIsInfinite = true;

    Rgb color{1};
    float radiance = 1;  // cd/m^2

    Rgb flux() const { return Rgb(0); }
    float power(float scene_radius) const { return 4 * sqr(kPi * scene_radius) * (luminance(color) * radiance); }
    float range_window(float) const { return 1; }

    bool sample(const LightPlace&, const Vec3&, Vec2 u, LightSample& s) const {
      s.delta = true;
      s.pdf = 1 / (4 * kPi);
      s.wi = square_to_sphere(u);
      s.distance = 0;
      s.radiance = color * radiance;
      return true;
    }

    Rgb emitted(const LightPlace&, const Vec3&, float) const { return color * radiance; }
    EmissionDensity emission_density(const SceneSphere&) const { return {1, 0, true, true}; }
    void sample_emission(const LightPlace&, const SceneSphere&, const EmissionRandom&, Emission&) const {}
    void resample_emission(const LightPlace&, const SceneSphere&, Vec2, Emission&) const {}
  };
  Emitter emitter(const Rgb& color) const { return {color, intensity}; }
};

}  // namespace etendue
