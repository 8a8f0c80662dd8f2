// Conversion of colours to and from sRGB.
#pragma once
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "spectrum/rgb.h"

namespace etendue::viewer {

inline Rgb linear_from_srgb(const Rgb& encoded) {
  return {srgb_to_linear(encoded.r), srgb_to_linear(encoded.g), srgb_to_linear(encoded.b)};
}

inline Rgb srgb_of_linear(const Rgb& color) {
  return {linear_to_srgb(color.r), linear_to_srgb(color.g), linear_to_srgb(color.b)};
}

// A linear colour as "#DDDBD7", clamped to [0, 1].
inline std::string srgb_hex(const Rgb& color) {
  const Rgb encoded = srgb_of_linear(color);
  const auto byte = [&](int c) { return static_cast<unsigned>(std::clamp(encoded[c], 0.0f, 1.0f) * 255 + 0.5f); };
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02X%02X%02X", byte(0), byte(1), byte(2));
  return text.data();
}

}  // namespace etendue::viewer
