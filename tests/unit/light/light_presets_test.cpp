// Presets of lights have the luminous flux or the illuminance that they state.
#include "light/light_presets.h"

#include <gtest/gtest.h>

namespace etendue::light_presets_test {
namespace {

TEST(LightPresets, HaveTheStatedFluxOrIlluminance) {
  for (const LightPreset& preset : kLightPresets) {
    int fitting = 0;
    for (const LightTypeInfo& type : light_type_infos()) {
      const Light light = make_light(type.description.name);
      if (!fits(preset, light)) continue;
      ++fitting;
      const Light set = with_preset(light, preset);
      const Rgb amount = preset.sun ? set.color * set.intensity() : set.flux();
      EXPECT_NEAR(luminance(amount), preset.amount, 1e-4 * preset.amount)
          << preset.name << " of " << type.description.name;
    }
    EXPECT_GT(fitting, 0) << preset.name;
  }
}

}  // namespace
}  // namespace etendue::light_presets_test
