#include "film/denoise/padded_plane.h"

#include <algorithm>

namespace etendue::film {
namespace {

int rounded_up(int value, int unit) { return (value + unit - 1) / unit * unit; }

}  // namespace

PaddedPlane::PaddedPlane(int width, int height, float value, float outside)
    : rows_(rounded_up(height, kTileHeight) + 2 * kBorder),
      stride_(static_cast<size_t>(rounded_up(width, kTileWidth) + 2 * kBorder)),
      values_(static_cast<size_t>(rows_) * stride_, outside) {
  for (int y = 0; y < height; ++y) std::fill_n(at(0, y), width, value);
}

PaddedPlane::PaddedPlane(int width, int height, const std::vector<float>& values) : PaddedPlane(width, height, 0, 0) {
  for (int row = 0; row < rows_; ++row) {
    const int y = std::clamp(row - kBorder, 0, height - 1);
    for (size_t column = 0; column < stride_; ++column) {
      const int x = std::clamp(static_cast<int>(column) - kBorder, 0, width - 1);
      values_[static_cast<size_t>(row) * stride_ + column] =
          values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    }
  }
}

int tile_count(int width, int height) {
  return rounded_up(width, kTileWidth) / kTileWidth * (rounded_up(height, kTileHeight) / kTileHeight);
}

TilePosition tile_position(int tile, int width) {
  const int columns = rounded_up(width, kTileWidth) / kTileWidth;
  return {.x = tile % columns * kTileWidth, .y = tile / columns * kTileHeight};
}

}  // namespace etendue::film
