// Settings that are no numbers.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void settings_that_are_no_numbers(Lab& lab) {
  const auto d = lab.document(scene::furnace(0.5f), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  for (const char* name : {"camera.yfov", "material.0.roughness", "material.0.emission.r", "display.exposure"})
    for (const char* value : {"nan", "inf", "-1e30", "1e39", "x"})
      lab.expect_zero(std::string("set:") + name + "=" + value, "accepted", render::with_text(d, name, value) ? 1 : 0);
}

inline constexpr Case kSettingsThatAreNoNumbers{
    "settings-that-are-no-numbers", Kind::bad_numbers,
    "A setting that is no number, or lies beyond its range, is refused before anything is rendered",
    settings_that_are_no_numbers};

}  // namespace etendue::stress
