// From radiance to what a screen shows: exposure, a tone curve, the sRGB encoding. shaders/display.frag does the same.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue::image {

enum class ToneCurve { none, neutral, aces, agx };

// Linear Rec. 709 in, display-linear out in [0, 1].
//   none     clipped
//   neutral  Khronos PBR Neutral, 2024: base colours come out as they are
//   aces     S. Hill's fit of the ACES reference rendering and output transforms, brightened by 1 / 0.6
//   agx      B. Wrensch's fit of T. Sobotka's AgX
Rgb tone_mapped(const Rgb& radiance, ToneCurve curve);

// Three bytes a pixel, sRGB-encoded and rounded; `exposure` in EV.
std::vector<uint8_t> display_pixels(std::span<const float> rgb, float exposure, ToneCurve curve);

}  // namespace etendue::image

template <>
struct etendue::Options<etendue::image::ToneCurve> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"none", "None"}, {"neutral", "PBR Neutral"}, {"aces", "ACES"}, {"agx", "AgX"}}};
};
