// Conversion of colours from sRGB.
#pragma once
#include "spectrum/rgb.h"

namespace etendue::viewer {

inline Rgb linear_from_srgb(const Rgb& encoded) {
  return {srgb_to_linear(encoded.r), srgb_to_linear(encoded.g), srgb_to_linear(encoded.b)};
}

}  // namespace etendue::viewer
