// The rectangles of pixels that are sampled as one task.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace etendue::integrator {

// One sample of each pixel of a rectangle, kWidth x kHeight pixels at most.
struct PixelBlock {
  static constexpr int kWidth = 32, kHeight = 16;
  static constexpr size_t kMostPixels = size_t{kWidth} * kHeight;
  int x, y, width, height;
  uint32_t sample;  // index among all samples of a pixel; even and odd ones belong to different half-buffers
};

// The block of an image of this size that contains a pixel.
inline PixelBlock block_containing(int x, int y, int image_width, int image_height, uint32_t sample) {
  const int left = x - x % PixelBlock::kWidth, top = y - y % PixelBlock::kHeight;
  return {.x = left,
          .y = top,
          .width = std::min(PixelBlock::kWidth, image_width - left),
          .height = std::min(PixelBlock::kHeight, image_height - top),
          .sample = sample};
}

}  // namespace etendue::integrator
