// An image plane with a border, so that loops over neighbours need no bounds checks
#pragma once
#include <cstddef>
#include <vector>

namespace etendue::film {

// Tiles are the unit of parallel work. The width is a multiple of the number of lanes of the regression.
inline constexpr int kTileWidth = 32;
inline constexpr int kTileHeight = 16;
inline constexpr int kTilePixels = kTileWidth * kTileHeight;

inline constexpr int kBorder = 8;  // pixels on each side

class PaddedPlane {
 public:
  PaddedPlane() = default;
  // A plane with `value` in the image and `outside` in the border.
  PaddedPlane(int width, int height, float value, float outside);
  // The values row by row; the border repeats the pixels at the edge.
  PaddedPlane(int width, int height, const std::vector<float>& values);

  size_t stride() const { return stride_; }
  // The address of a pixel, which may lie in the border.
  const float* at(int x, int y) const {
    return values_.data() + static_cast<ptrdiff_t>(y + kBorder) * static_cast<ptrdiff_t>(stride_) + x + kBorder;
  }
  float* at(int x, int y) { return const_cast<float*>(static_cast<const PaddedPlane&>(*this).at(x, y)); }

 private:
  int rows_ = 0;
  size_t stride_ = 0;
  std::vector<float> values_;
};

// The position of the first pixel of a tile.
struct TilePosition {
  int x = 0;
  int y = 0;
};
int tile_count(int width, int height);
TilePosition tile_position(int tile, int width);

}  // namespace etendue::film
