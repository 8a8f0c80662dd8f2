// Spot light: a point light whose intensity falls off from its axis.       [Lang, Definition 4.35; KHR_lights_punctual]
//
//   E = I p(alpha) cos(theta) / r^2,    Phi = 2 pi I (integral of p over the cosine)
//
// alpha is the angle to the axis. With t = (cos alpha - cos outer) / (cos inner - cos outer), limited to [0, 1], the
// profile p is t^2 as in KHR_lights_punctual, t^2 (3 - 2 t), or t^4; or cos^n alpha within the outer cone.
#pragma once
#include "light/types/punctual_emitter.h"

namespace etendue {

enum class SpotProfile : uint8_t { squared, smoothstep, quartic, cosine };

}  // namespace etendue

template <>
struct etendue::Options<etendue::SpotProfile> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"squared", "Squared (glTF)"},
                                                            {"smoothstep", "Smoothstep"},
                                                            {"quartic", "Quartic"},
                                                            {"cosine", "Power of the cosine"}}};
};

namespace etendue {

struct SpotLight {
  static constexpr LightTypeDescription kDescription{
      .name = "spot",
      .label = "Spot light",
      .summary = "A point light that emits into a cone and falls off towards its edge",
      .light_class = LightClass::delta_position,
      .quantity = &kLuminousIntensity,
      .formula =
          "E = I p cos / r^2; p = t^2 (glTF), t^2 (3 - 2 t) or t^4 with t = (cos a - cos a_outer) / "
          "(cos a_inner - cos a_outer), or cos^n a within the outer cone",
      .sampling = "its position; rays that leave it are uniform over the outer cone",
      .source = "[Lang, Definition 4.35]; KHR_lights_punctual",
      .punctual = true,
  };

  Number<float> intensity = intensity_parameter(kLuminousIntensity, "Luminous intensity on the axis");
  Number<float> inner_cone{"inner-cone", "Inner cone", 0, {0, kPi / 2}, "Half angle of the cone of full intensity",
                           "rad"};
  Number<float> outer_cone{
      "outer-cone", "Outer cone", kPi / 4, {0, kPi / 2}, "Half angle beyond which the light emits nothing", "rad"};
  Choice<SpotProfile> profile{"profile", "Profile", SpotProfile::squared,
                              "Falloff from the inner to the outer cone; a power of the cosine has no inner cone"};
  Number<float> exponent{"exponent", "Exponent", 1, {0, 1000}, "Exponent of the cosine profile; higher is narrower"};
  Number<float> range = range_parameter();
  auto parameters() { return std::tie(intensity, inner_cone, outer_cone, profile, exponent, range); }

  struct Emitter : PunctualEmitter {
    float outer_cone = kPi / 4;  // radians
    float cos_inner = 1, cos_outer = 0;
    SpotProfile profile = SpotProfile::squared;
    float exponent = 1;

    // The share of the intensity on the axis; `cosine` is that of the angle to the axis.
    float falloff(float cosine) const {
      if (profile == SpotProfile::cosine) return cosine > cos_outer ? std::pow(std::max(cosine, 0.0f), exponent) : 0;
      const float scale = 1 / std::max(1e-7f, cos_inner - cos_outer);
      const float t = std::clamp((cosine - cos_outer) * scale, 0.0f, 1.0f);
      switch (profile) {
        case SpotProfile::smoothstep:
          return t * t * (3 - 2 * t);
        case SpotProfile::quartic:
          return sqr(sqr(t));
        default:
          return sqr(t);
      }
    }

    // The solid angle that emits the same power at the intensity of the axis.
    float solid_angle() const {
      const float outer = std::max(cos_outer, 0.0f);
      const float inner = std::max(cos_inner, outer);
      if (profile == SpotProfile::cosine) return 2 * kPi * (1 - std::pow(outer, exponent + 1)) / (exponent + 1);
      return 2 * kPi * (1 - inner + mean_between_cones() * (inner - outer));
    }
    Rgb flux() const { return color * (solid_angle() * intensity); }
    float power(float) const { return luminance(flux()); }

    LightBounds bounds(const LightPlace& place) const {
      LightBounds b = PunctualEmitter::bounds(place);
      b.axis = place.direction;
      b.normals = 0;
      b.emission = outer_cone;
      return b;
    }

    bool sample(const LightPlace& place, const Vec3& from, Vec2, LightSample& s) const {
      if (!sample_point(place, from, s)) return false;
      s.radiance *= falloff(-glm::dot(s.wi, place.direction));
      return !is_black(s.radiance);
    }

    Rgb emitted(const LightPlace& place, const Vec3& direction, float distance) const {
      return radiant_intensity() * (falloff(glm::dot(direction, place.direction)) * range_window(distance));
    }
    EmissionDensity emission_density(const SceneSphere&) const {
      return {1, 1 / (2 * kPi * std::max(1 - cos_outer, 1e-7f)), true, false};
    }
    void sample_emission(const LightPlace& place, const SceneSphere& scene, const EmissionRandom& random,
                         Emission& e) const {
      e.position = place.position;
      resample_emission(place, scene, random.direction, e);
    }
    void resample_emission(const LightPlace& place, const SceneSphere&, Vec2 u, Emission& e) const {
      const Vec3 local = square_to_cone(u, cos_outer);
      e.direction = Frame(place.direction).to_world(local);
      e.radiance = radiant_intensity() * falloff(local.z);
    }

   private:
    // The mean of the falloff over the cosine, between the two cones.
    float mean_between_cones() const {
      switch (profile) {
        case SpotProfile::smoothstep:
          return 1 / 2.0f;
        case SpotProfile::quartic:
          return 1 / 5.0f;
        default:
          return 1 / 3.0f;
      }
    }
  };
  Emitter emitter(const Rgb& color) const {
    return {{color, intensity, range_or_infinity(range)},
            outer_cone,
            std::cos(inner_cone.value),
            std::cos(outer_cone.value),
            profile,
            exponent};
  }
};

}  // namespace etendue
