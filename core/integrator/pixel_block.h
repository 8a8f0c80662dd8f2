// The rectangles of pixels that are sampled as one task.
#pragma once
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

}  // namespace etendue::integrator
