// Conversion of radiance to display values: exposure, tone mapping and sRGB encoding
//
// shaders/display.frag computes the same on the GPU.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue::image {

enum class ToneCurve { none, neutral, aces, agx };

// Maps scene-referred linear Rec. 709 values to display-linear values in [0, 1].
//   none     clamps
//   neutral  Khronos PBR Neutral [Khronos 2024], which preserves base colours below 0.8
//   aces     fit of the ACES reference rendering and output transforms [Hill 2017], scaled by 1 / 0.6
//   agx      fit of AgX [Sobotka 2022] by [Wrensch 2023]
Rgb tone_mapped(const Rgb& radiance, ToneCurve curve);

// The displayed value, from 0 to 1 and sRGB encoded. `exposure` is in stops.
Rgb displayed(const Rgb& radiance, float exposure, ToneCurve curve);

// 8-bit sRGB values of linear RGB pixels. `exposure` is in stops: values are multiplied by 2^exposure.
std::vector<uint8_t> display_pixels(std::span<const float> rgb, float exposure, ToneCurve curve);

}  // namespace etendue::image

template <>
struct etendue::Options<etendue::image::ToneCurve> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"none", "Linear (sRGB)"}, {"neutral", "PBR Neutral"}, {"aces", "ACES"}, {"agx", "AgX"}}};
};
