// Familiar lights with their luminous flux or illuminance; round figures, as handbooks give them.
#pragma once
#include <array>

#include "light/light.h"

namespace etendue {

struct LightPreset {
  const char* name;
  const char* label;
  bool sun;  // a directional light, `amount` in lx; else any light with a flux, `amount` in lm
  double amount;
  Rgb color;  // its largest component is one
};

inline constexpr std::array<LightPreset, 10> kLightPresets{{
    {"candle", "Candle: 12.6 lm (1 cd)", false, 12.566, {1, 0.58f, 0.16f}},
    {"bulb-40", "Light bulb, 40 W: 415 lm", false, 415, {1, 0.71f, 0.42f}},
    {"bulb-60", "Light bulb, 60 W: 710 lm", false, 710, {1, 0.71f, 0.42f}},
    {"bulb-100", "Light bulb, 100 W: 1340 lm", false, 1340, {1, 0.72f, 0.43f}},
    {"led", "LED bulb: 806 lm", false, 806, {1, 0.79f, 0.55f}},
    {"tube", "Fluorescent tube, 36 W: 3350 lm", false, 3350, {1, 0.94f, 0.84f}},
    {"flood", "Floodlight: 20000 lm", false, 20000, {1, 0.93f, 0.83f}},
    {"sun", "Sun at noon: 100000 lx", true, 100000, {1, 0.96f, 0.9f}},
    {"evening-sun", "Sun near the horizon: 500 lx", true, 500, {1, 0.55f, 0.2f}},
    {"full-moon", "Full moon: 0.25 lx", true, 0.25, {0.95f, 0.97f, 1}},
}};

inline bool fits(const LightPreset& preset, const Light& light) {
  const LightClass light_class = light.info().description.light_class;
  return light_class != LightClass::ambient && preset.sun == (light_class == LightClass::delta_direction);
}

// The light with the preset's colour and amount.
inline Light with_preset(Light light, const LightPreset& preset) {
  light.color = preset.color;
  light.set("intensity", 1.0);
  const double one = static_cast<double>(luminance(preset.sun ? light.color : light.flux()));
  if (one > 0) light.set("intensity", preset.amount / one);
  return light;
}

}  // namespace etendue
