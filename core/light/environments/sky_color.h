// The colour of skies.
#pragma once
#include <algorithm>

#include "spectrum/rgb.h"

namespace etendue {

// Linear sRGB of XYZ; negative components are set to zero.
inline Rgb rgb_of_sky(double x, double y, double z) {
  const auto clipped = [](double v) { return static_cast<float>(std::max(v, 0.0)); };
  return {clipped(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
          clipped(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
          clipped(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

}  // namespace etendue
