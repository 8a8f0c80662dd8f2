// Settings that are not finite numbers or out of range.   [IEEE 754]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void settings_that_are_no_numbers(TestContext& test) {
  const auto d = test.document(scene::furnace(0.5f), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  for (const char* name : {"camera.yfov", "material.0.roughness", "material.0.emission.r", "display.exposure"})
    for (const char* value : {"nan", "inf", "-1e30", "1e39", "x"})
      test.expect_zero(std::string("set:") + name + "=" + value, "accepted", render::with_text(d, name, value) ? 1 : 0);
}

inline constexpr Case kSettingsThatAreNoNumbers{
    .name = "settings-that-are-no-numbers",
    .kind = Kind::invalid_numbers,
    .theory =
        "A setting that is not a number or lies outside its range is rejected before anything is "
        "rendered",
    .run = settings_that_are_no_numbers};

}  // namespace etendue::stress
