#include "film/denoise/patch_weights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "base/vectorize.h"

namespace etendue::film {
namespace {

constexpr int kWideWidth = kTileWidth + 2 * kPatchRadius;
constexpr int kWideHeight = kTileHeight + 2 * kPatchRadius;

using WideRow = std::array<float, kWideWidth>;
using TileRow = std::array<float, kTileWidth>;

// Adds the squared differences of two rows of one channel.
ETENDUE_VECTORIZE void add_squares(const float* p, const float* q, WideRow& squares) {
  for (size_t i = 0; i < kWideWidth; ++i) squares[i] += (p[i] - q[i]) * (p[i] - q[i]);
}

// Replaces mean squared differences by their excess over the noise, in units of the variance, and sums them along the
// width of a patch.
ETENDUE_VECTORIZE void sum_columns(WideRow& squares, float scale, const float* p_variance, const float* q_variance,
                                   float min_variance, TileRow& sums) {
  for (size_t i = 0; i < kWideWidth; ++i) {
    const float p = p_variance[i], q = q_variance[i];
    const float noise = p + (p < q ? p : q);
    squares[i] = (squares[i] * scale - noise) / (min_variance + p + q);
  }
  for (size_t i = 0; i < kTileWidth; ++i)
    sums[i] = squares[i] + squares[i + 1] + squares[i + 2] + squares[i + 3] + squares[i + 4];
}

// exp(-max(sum / pixels of a patch, 0)) times `valid`. The relative error of the polynomial is below 1e-4.
ETENDUE_VECTORIZE void weights_of_row(const TileRow* sums, const float* valid, float* weights) {
  constexpr float kScale = 1.0f / static_cast<float>((2 * kPatchRadius + 1) * (2 * kPatchRadius + 1));
  constexpr float kLog2e = 1.44269504f;
  for (size_t i = 0; i < kTileWidth; ++i) {
    const float sum = sums[0][i] + sums[1][i] + sums[2][i] + sums[3][i] + sums[4][i];
    float exponent = sum * (kScale * kLog2e);
    exponent = exponent > 0 ? exponent : 0;
    exponent = exponent < 100 ? exponent : 100;
    const auto whole = static_cast<int32_t>(exponent);
    const float x = static_cast<float>(whole) - exponent;  // in (-1, 0]
    const float power =
        1 + x * (0.69314718f + x * (0.24022651f + x * (0.05550411f + x * (0.00961813f + x * 0.00133336f))));
    weights[i] = valid[i] * power * std::bit_cast<float>((127 - whole) << 23);
  }
}

void weights_of_offset(const GuideImage& guide, const PaddedPlane& valid, TilePosition tile, int dx, int dy,
                       float* weights) {
  std::array<TileRow, kWideHeight> sums;
  const float scale = 1.0f / static_cast<float>(guide.channels.size());
  for (int row = 0; row < kWideHeight; ++row) {
    const int x = tile.x - kPatchRadius, y = tile.y - kPatchRadius + row;
    WideRow squares{};
    for (const PaddedPlane& channel : guide.channels)
      add_squares(channel.at(x, y), channel.at(x + dx, y + dy), squares);
    sum_columns(squares, scale, guide.variance->at(x, y), guide.variance->at(x + dx, y + dy), guide.min_variance,
                sums[static_cast<size_t>(row)]);
  }
  for (int row = 0; row < kTileHeight; ++row)
    weights_of_row(&sums[static_cast<size_t>(row)], valid.at(tile.x + dx, tile.y + row + dy),
                   weights + row * kTileWidth);
}

}  // namespace

void patch_weights(const GuideImage& guide, const PaddedPlane& valid, TilePosition tile, int radius,
                   std::vector<float>& weights) {
  const auto diameter = static_cast<size_t>(2 * radius + 1);
  weights.resize(diameter * diameter * kTilePixels);
  float* next = weights.data();
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx, next += kTilePixels) weights_of_offset(guide, valid, tile, dx, dy, next);
}

}  // namespace etendue::film
