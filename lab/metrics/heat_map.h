// Difference of two images as a false-colour image: 8-bit RGB, row by row.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "image/image.h"

namespace etendue::metrics {

enum class HeatMap { absolute, relmse, difference, flip };

// Maps of linear pixels x against a reference r of the same size, averaged over the channels.
//   absolute    |x - r| divided by the mean of the reference, in viridis; 1 is the upper end
//   relmse      root of (x - r)^2 / (r^2 + 0.01), in viridis
//   difference  (x - r) divided by the mean of the reference: blue is too dark, white is equal, red is too bright
// HeatMap::flip is not handled here: pass the result of flip_map to `color_mapped`.
std::vector<uint8_t> heat_map(const image::LayeredImage& image, const image::LayeredImage& reference,
                              HeatMap kind = HeatMap::absolute);

// Numbers in [0, 1], one per pixel, in viridis.
std::vector<uint8_t> color_mapped(std::span<const float> map);

}  // namespace etendue::metrics

template <>
struct etendue::Options<etendue::metrics::HeatMap> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"absolute", "Absolute difference"}, {"relmse", "Relative error"}, {"signed", "Signed"}, {"flip", "FLIP"}}};
};
