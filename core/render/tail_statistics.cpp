#include "render/tail_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace etendue::render {
namespace {

constexpr uint32_t kFirstUsedSample = 2;

// Number of deviations stored per tile: about 4 bytes per pixel, and half of that for images with so many tiles that it
// would exceed 32 MiB.
size_t tail_capacity(size_t tiles) { return tiles <= 16384 ? 512 : 256; }

// The sum of the luminances of all samples of a pixel.
double luminance_of(const film::Film::Pixel& p) {
  return 0.212671 * (p.sum[0][0] + p.sum[1][0]) + 0.715160 * (p.sum[0][1] + p.sum[1][1]) +
         0.072169 * (p.sum[0][2] + p.sum[1][2]);
}

}  // namespace

size_t TailStatistics::tile_count(int width, int height) {
  return static_cast<size_t>((width + kWidth - 1) / kWidth) * static_cast<size_t>((height + kHeight - 1) / kHeight);
}

size_t TailStatistics::capacity(int width, int height) { return tail_capacity(tile_count(width, height)); }

TailStatistics::TailStatistics(int width, int height)
    : width_(width),
      height_(height),
      tails_(tile_count(width, height), film::TailAccumulator(tail_capacity(tile_count(width, height)))) {}

int TailStatistics::pixels_of(int tile) const {
  const int x = tile % columns() * kWidth;
  const int y = tile / columns() * kHeight;
  return std::min(kWidth, width_ - x) * std::min(kHeight, height_ - y);
}

void TailStatistics::add(const integrator::PixelBlock& block, std::span<const Rgb> radiance, film::Film& film) {
  const uint32_t earlier = film.samples(block.x, block.y);
  const double per_sample = 1 / std::max(1.0, static_cast<double>(earlier));
  // The mean of n samples is uncertain too. This factor gives the deviation from it the variance of a sample
  // [Welford 1962].
  const double scale = std::sqrt(earlier / (earlier + 1.0));
  std::array<float, integrator::PixelBlock::kMostPixels> deviations;
  double sum = 0;
  size_t i = 0;
  for (int y = block.y; y < block.y + block.height; ++y) {
    auto* pixel = &film.pixels()[static_cast<size_t>(y) * static_cast<size_t>(width_)];
    for (int x = block.x; x < block.x + block.width; ++x, ++i) {
      const double expected = luminance_of(pixel[x]) * per_sample;
      const bool is_valid = film.add(pixel[x], x, y, block.sample % film::kHalfBuffers, radiance[i]);
      const double value = is_valid ? static_cast<double>(luminance(radiance[i])) : 0;
      deviations[i] = static_cast<float>((value - expected) * scale);
      sum += value;
    }
  }
  if (earlier < kFirstUsedSample) return;
  const int tile = block.y / kHeight * columns() + block.x / kWidth;
  tails_[static_cast<size_t>(tile)].add(std::span(deviations).first(i), sum);
}

void TailStatistics::clear() {
  for (auto& tail : tails_) tail.clear();
}

std::vector<film::TailState> TailStatistics::states() const {
  std::vector<film::TailState> states;
  for (const auto& tail : tails_) states.push_back(tail.state());
  return states;
}

void TailStatistics::restore(std::span<const film::TailState> states) {
  for (size_t i = 0; i < tails_.size(); ++i) tails_[i] = film::TailAccumulator(tail_capacity(tails_.size()), states[i]);
}

size_t TailStatistics::memory(int width, int height) {
  const size_t tiles = tile_count(width, height);
  return tiles * (sizeof(film::TailAccumulator) + tail_capacity(tiles) * sizeof(float));
}

}  // namespace etendue::render
