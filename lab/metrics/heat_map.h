// Where two pictures differ, as a picture: 8-bit RGB, row by row.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "image/image.h"

namespace etendue::metrics {

enum class HeatMap { absolute, relmse, difference, flip };

// Of linear pixels, averaged over the channels; both images have one size.
//   absolute    |x - r| relative to the mean of the reference, through viridis: one is yellow
//   relmse      the root of (x - r)^2 / (r^2 + 0.01), the same way
//   difference  x - r relative to the mean of the reference: blue is too dark, white is right, red is too bright
// HeatMap::flip has a map of its own that is painted by `painted`.
std::vector<uint8_t> heat_map(const image::LayeredImage& picture, const image::LayeredImage& reference,
                              HeatMap kind = HeatMap::absolute);

// Numbers from 0 to 1, one a pixel, through viridis.
std::vector<uint8_t> painted(std::span<const float> map);

}  // namespace etendue::metrics

template <>
struct etendue::Options<etendue::metrics::HeatMap> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"absolute", "Absolute difference"}, {"relmse", "Relative error"}, {"signed", "Signed"}, {"flip", "FLIP"}}};
};
