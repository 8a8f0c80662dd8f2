// Exposure from -15 to 15 stops.
#pragma once
#include "image/display.h"
#include "stress/case.h"

namespace etendue::stress {

inline void thirty_stops(Lab& lab) {
  const std::vector<float> pixel{0.18f, 0.18f, 0.18f};
  for (const auto& option : Options<image::ToneCurve>::kOptions) {
    const auto curve = static_cast<image::ToneCurve>(&option - Options<image::ToneCurve>::kOptions.data());
    int falls = 0;
    uint8_t before = 0;
    for (float stops = -15; stops <= 15; stops += 0.5f) {
      const uint8_t shown = image::display_pixels(pixel, stops, curve)[0];
      falls += shown < before;
      before = shown;
    }
    lab.expect_zero(std::string("display:curve=") + std::string(option.name), "steps that fall", falls);
    lab.expect_between(std::string("display:curve=") + std::string(option.name), "brightest", before, 225, 255);
  }
}

inline constexpr Case kThirtyStops{
    "thirty-stops", Kind::parameters,
    "The display transform rises with exposure and stays within its range over thirty stops, for every tone curve",
    thirty_stops};

}  // namespace etendue::stress
