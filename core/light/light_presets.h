// Lamps and skies that people know, in the units in which they are known. Round figures, as handbooks give them.
#pragma once
#include <array>

#include "light/flux.h"
#include "spectrum/photometry.h"

namespace etendue {

struct LightPreset {
  const char* name;
  const char* label;
  bool sun;  // illuminance of parallel light, lx; else the luminous flux of a lamp, lm
  double amount;
  Rgb color;  // the largest band one
};

inline constexpr std::array<LightPreset, 10> kLightPresets{{
    {"candle", "Candle: 12.6 lm (1 cd)", false, 12.566, {1, 0.58f, 0.16f}},
    {"bulb-40", "Bulb of 40 W: 415 lm", false, 415, {1, 0.71f, 0.42f}},
    {"bulb-60", "Bulb of 60 W: 710 lm", false, 710, {1, 0.71f, 0.42f}},
    {"bulb-100", "Bulb of 100 W: 1340 lm", false, 1340, {1, 0.72f, 0.43f}},
    {"led", "LED lamp: 806 lm", false, 806, {1, 0.79f, 0.55f}},
    {"tube", "Fluorescent tube of 36 W: 3350 lm", false, 3350, {1, 0.94f, 0.84f}},
    {"flood", "Floodlight: 20000 lm", false, 20000, {1, 0.93f, 0.83f}},
    {"sun", "Sun at noon: 100000 lx", true, 100000, {1, 0.96f, 0.9f}},
    {"evening-sun", "Sun near the horizon: 500 lx", true, 500, {1, 0.55f, 0.2f}},
    {"full-moon", "Full moon: 0.25 lx", true, 0.25, {0.95f, 0.97f, 1}},
}};

inline bool fits(const LightPreset& preset, const Light& light) {
  return light.type != LightType::ambient && preset.sun == (light.type == LightType::directional);
}

// The light with the preset's colour and amount.
inline Light with_preset(Light light, const LightPreset& preset, Efficacy efficacy) {
  light.color = preset.color;
  light.intensity = 1;
  const double one = photometric(preset.sun ? light.color : flux_of(light), efficacy);
  if (one > 0) light.intensity = static_cast<float>(preset.amount / one);
  return light;
}

}  // namespace etendue
