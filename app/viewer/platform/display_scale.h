// The scale of the interface where the system states none.
#pragma once
#include <algorithm>
#include <cmath>

namespace etendue::viewer {

// Pixels per unit of the interface on a display of this height: 1 below 1350 pixels, 1.25 at 1440, 2 at 2160.
inline float scale_for_height(int pixels) {
  constexpr float kUsualHeight = 1080;
  return std::max(1.0f, std::floor(static_cast<float>(pixels) / kUsualHeight * 4) / 4);
}

}  // namespace etendue::viewer
