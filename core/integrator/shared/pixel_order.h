// The order of the pixels of a block: squares of 4 x 4, so that the camera rays of a packet are coherent.
#pragma once
#include <array>
#include <cstdint>

#include "integrator/integrator.h"

namespace etendue::integrator {

class PixelOrder {
 public:
  explicit PixelOrder(const PixelBlock& block) : width_(block.width) {
    constexpr int kSquare = 4;
    for (int top = 0; top < block.height; top += kSquare)
      for (int left = 0; left < block.width; left += kSquare)
        for (int y = top; y < std::min(top + kSquare, block.height); ++y)
          for (int x = left; x < std::min(left + kSquare, block.width); ++x)
            pixels_[static_cast<size_t>(size_++)] = {static_cast<uint8_t>(x), static_cast<uint8_t>(y)};
  }

  int size() const { return size_; }
  // Coordinates and index within the block.
  int x(int i) const { return pixels_[static_cast<size_t>(i)].x; }
  int y(int i) const { return pixels_[static_cast<size_t>(i)].y; }
  size_t index(int i) const { return static_cast<size_t>(y(i) * width_ + x(i)); }

 private:
  struct Pixel {
    uint8_t x, y;
  };
  std::array<Pixel, PixelBlock::kMostPixels> pixels_;
  int width_, size_ = 0;
};

}  // namespace etendue::integrator
