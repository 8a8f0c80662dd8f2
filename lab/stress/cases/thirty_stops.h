// Exposure from -15 to 15 stops.   [IEC 61966-2-1]
#pragma once
#include "image/display.h"
#include "stress/case.h"

namespace etendue::stress {

inline void thirty_stops(TestContext& test) {
  const std::vector<float> pixel{0.18f, 0.18f, 0.18f};
  for (const auto& option : Options<image::ToneCurve>::kOptions) {
    const auto curve = static_cast<image::ToneCurve>(&option - Options<image::ToneCurve>::kOptions.data());
    int decreases = 0;
    uint8_t previous = 0;
    for (float stops = -15; stops <= 15; stops += 0.5f) {
      const uint8_t shown = image::display_pixels(pixel, stops, curve)[0];
      decreases += shown < previous;
      previous = shown;
    }
    test.expect_zero(std::string("display:curve=") + std::string(option.name), "decreasing steps", decreases);
    test.expect_between(std::string("display:curve=") + std::string(option.name), "maximum value", previous, 225, 255);
  }
}

inline constexpr Case kThirtyStops{
    .name = "thirty-stops",
    .kind = Kind::parameters,
    .theory =
        "The display transform increases with exposure and stays within its range for every tone "
        "curve",
    .run = thirty_stops};

}  // namespace etendue::stress
