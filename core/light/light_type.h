// Light types: how a kind of light emits, and how it is sampled.
//
// A light type is a struct in a header of its own under light/types/, registered by one line of types/registry.h. It
// has a `kDescription`, parameters (base/parameter.h) that `auto parameters()` lists, one of which is `intensity`, and
// one of two interfaces.
//
// A light without extent prepares its parameters for sampling. `color` multiplies the intensity.
//
//   struct Emitter {
//     static constexpr bool kIsInfinite;  // without a position, which the light tree needs
//
//     // The whole emitted flux, lm; zero where it depends on the scene.
//     Rgb flux() const;
//     // The luminance of the power that enters a scene of this radius, lm: the weight when lights are chosen.
//     float power(float scene_radius) const;
//     // Position, directions and intensity for the light tree; unless kIsInfinite.
//     LightBounds bounds(const LightPlace& place) const;
//     // The remaining share of the emission after `distance` metres (KHR_lights_punctual).
//     float range_window(float distance) const;
//
//     // Light that arrives at `from`: direction, distance, density and radiance of `s`; false if none does.
//     bool sample(const LightPlace& place, const Vec3& from, Vec2 u, LightSample& s) const;
//
//     // What the light emits in a direction, at a distance: cd from a point, lx along a beam. Includes the
//     // window of a finite range, not the inverse square.
//     Rgb emitted(const LightPlace& place, const Vec3& direction, float distance) const;
//     // The densities of `sample_emission`; `second` is zero if no ray can leave the light.
//     EmissionDensity emission_density(const SceneSphere& scene) const;
//     // A ray that leaves the light: position, direction and radiance of `e`.
//     void sample_emission(const LightPlace& place, const SceneSphere& scene, const EmissionRandom& random,
//                          Emission& e) const;
//     // The same with another second end: direction of a point light, position of a beam.
//     void resample_emission(const LightPlace& place, const SceneSphere& scene, Vec2 u, Emission& e) const;
//   };
//   Emitter emitter(const Rgb& color) const;
//
// An area light derives from AreaLightParameters, which defines its emission, and adds its surface. Rays hit it; it
// faces the -z axis of its node.
//
//   float area() const;   // one side, m^2
//   S shape() const;      // S is std::shared_ptr<const Mesh>, or AnalyticShape for a sphere or disk
//   LightPlace point_sample(const SpreadPoint& p) const;  // one of evenly spread points, with its normal
//
// Meshes are sampled triangle by triangle (sampling/triangle_batch.h). A type with a AnalyticShape names its kind and
// samples it, with points given by the two surface coordinates of AnalyticShape.
//
//   static constexpr AnalyticShape::Kind kShape;
//   static Vec2 sample_area(Vec2 u);  // uniform over the surface
//   // A point as the receiver sees it, by solid angle where that is possible.
//   static bool sample_from(const AnalyticShape& shape, const Vec3& from, Vec2 u, Vec2& at);
//   // Its density per solid angle.
//   static float pdf_from(const AnalyticShape& shape, const Vec3& from, const Vec3& point);
//   static LightBounds bounds(const AnalyticShape& shape, bool two_sided, float intensity);
#pragma once
#include <array>
#include <source_location>

#include "base/parameter.h"

namespace etendue {

// Delta lights are never hit by a ray, area lights are. Ambient light arrives from every direction and is never hit.
enum class LightClass : uint8_t { delta_position, delta_direction, area, ambient };

// A photometric quantity, and the radiometric one that follows by the luminous efficacy (spectrum/photometry.h).
struct LightQuantity {
  const char* name;
  const char* unit;
  const char* radiometric_name;
  const char* radiometric_unit;
};

inline constexpr LightQuantity kLuminousIntensity{"Luminous intensity", "cd", "Radiant intensity", "W/sr"};
inline constexpr LightQuantity kIlluminance{"Illuminance", "lx", "Irradiance", "W/m^2"};
inline constexpr LightQuantity kLuminance{"Luminance", "cd/m^2", "Radiance", "W/(m^2 sr)"};
inline constexpr LightQuantity kLuminousFlux{"Luminous flux", "lm", "Radiant flux", "W"};

struct LightTypeDescription {
  const char* name;     // in files and commands
  const char* label;    // in menus
  const char* summary;  // one sentence
  LightClass light_class;
  const LightQuantity* quantity;  // of the intensity
  const char* formula;                  // irradiance E of a receiver with the angle theta between normal and light
  const char* sampling;                 // how a receiver samples it
  const char* source;                   // where the definition is from
  bool punctual = false;                // a type of KHR_lights_punctual, of the same name
  // The source file that contains the description, for the manual.
  const char* file = std::source_location::current().file_name();
};

// The parameter `intensity` of a light type.
inline Number<float> intensity_parameter(const LightQuantity& quantity, const char* doc) {
  return {"intensity", "Intensity", 1, {0, 1e9f}, doc, quantity.unit, Scale::logarithmic};
}

}  // namespace etendue

template <>
struct etendue::Options<etendue::LightClass> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"delta-position", "Delta position"},
                                                            {"delta-direction", "Delta direction"},
                                                            {"area", "Area"},
                                                            {"ambient", "Ambient"}}};
};
