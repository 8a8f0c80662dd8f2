// Emission of area lights: radiance that falls off as a power of the cosine to the normal.
//
//   L(theta) = L0 cos^k(theta),    Phi = 2 pi A s L0 / (k + 2)
//
// A is the area of one side, s the number of sides. Rays see an area light as a black surface that emits.
//
// Point samples replace the surface by N lights without extent, each with an equal share A / N of the area
// [Lang, eq. 4.371, corrected]:
//
//   E = sum over k of (A / N) L cos(theta) cos(theta_light) / r_k^2
#pragma once
#include <array>

#include "light/light_place.h"
#include "light/light_type.h"
#include "spectrum/rgb.h"

namespace etendue {

enum class AreaLightQuantity : uint8_t { radiance, power };

}  // namespace etendue

template <>
struct etendue::Options<etendue::AreaLightQuantity> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"radiance", "Luminance"}, {"power", "Luminous flux"}}};
};

namespace etendue {

struct AreaLightParameters {
  Number<float> intensity =
      intensity_parameter(kLuminance, "Luminance along the normal, or the luminous flux of all sides (see Quantity)");
  Choice<AreaLightQuantity> quantity{"quantity", "Quantity", AreaLightQuantity::radiance,
                                     "Quantity that the intensity gives"};
  Number<float> cosine_exponent{
      "focus",
      "Cosine exponent",
      0,
      {0, 1000},
      "Radiance is proportional to this power of the cosine to the normal. 0 is diffuse; higher "
      "concentrates the light"};
  Toggle two_sided{"two-sided", "Two-sided", false, "Emits from the back as well"};
  Number<int> point_samples{
      "points",
      "Point samples",
      0,
      {0, 4096},
      "Number of point lights that replace the surface, which becomes invisible. Shadows are hard; "
      "few points cause banding. 0 keeps the surface"};

  int sides() const { return two_sided ? 2 : 1; }

  // Power over the radiance along the normal, m^2 sr. `area` is that of one side.
  float power_per_radiance(float area) const {
    return 2 * kPi / (cosine_exponent + 2) * area * static_cast<float>(sides());
  }
  // Along the normal, cd/m^2.
  Rgb radiance(const Rgb& color, float area) const {
    const float divisor = quantity == AreaLightQuantity::power ? power_per_radiance(area) : 1;
    return divisor > 0 ? color * (intensity / divisor) : Rgb(0);
  }
  // Flux of all sides, lm.
  Rgb flux(const Rgb& color, float area) const { return radiance(color, area) * power_per_radiance(area); }

 protected:
  // The unit of the intensity follows the quantity.
  template <class... Size>
  auto parameters_with_size(Size&... size) {
    intensity.unit = quantity == AreaLightQuantity::power ? kLuminousFlux.unit : kLuminance.unit;
    return std::tie(intensity, size..., quantity, cosine_exponent);
  }
};

// A length of an area light.
inline Number<float> size_parameter(const char* name, const char* label, float value, const char* doc) {
  return {name, label, value, {0, 1e6f}, doc, "m", Scale::logarithmic};
}

// Point k of n, spread evenly: along one coordinate in n equal steps, along the other by the golden angle. Any n gives
// an even distribution.
struct SpreadPoint {
  float fraction;  // (k + 1/2) / n
  float turn;      // in [0, 1)
  int count;       // n

  SpreadPoint(int k, int n) : fraction((static_cast<float>(k) + 0.5f) / static_cast<float>(n)), count(n) {
    constexpr float kGoldenRatio = 0.6180340f;
    turn = kGoldenRatio * static_cast<float>(k);
    turn -= std::floor(turn);
  }
  // The turn as a point of the unit circle.
  Vec2 circle() const { return {std::cos(2 * kPi * turn), std::sin(2 * kPi * turn)}; }
};

}  // namespace etendue
