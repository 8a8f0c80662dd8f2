// The rectangles of pixels that integrators sample at a time.
#pragma once
#include <cstddef>
#include <cstdint>

namespace etendue::integrator {

// One sample of each pixel of a rectangle, kWidth x kHeight pixels at most.
struct PixelBlock {
  static constexpr int kWidth = 32, kHeight = 16;
  static constexpr size_t kMostPixels = size_t{kWidth} * kHeight;
  int x, y, width, height;
  uint32_t sample;  // counts all samples of a pixel: it alternates between the film's halves
};

}  // namespace etendue::integrator
