#include "render/tail_statistics.h"

namespace etendue::render {
namespace {

constexpr uint32_t kFirstWatched = 2;

// Deviations kept in a tile: about 2 bytes a pixel, and half as many where that would be more than 16 MiB.
size_t capacity_of(size_t tiles) { return tiles <= 16384 ? 256 : 128; }

size_t tiles_of(int width, int height) {
  return static_cast<size_t>((width + TailStatistics::kWidth - 1) / TailStatistics::kWidth) *
         static_cast<size_t>((height + TailStatistics::kHeight - 1) / TailStatistics::kHeight);
}

double luminance_of(const film::Film::Pixel& p) {
  return 0.212671 * (p.sum[0][0] + p.sum[1][0]) + 0.715160 * (p.sum[0][1] + p.sum[1][1]) +
         0.072169 * (p.sum[0][2] + p.sum[1][2]);
}

}  // namespace

TailStatistics::TailStatistics(int width, int height)
    : width_(width),
      height_(height),
      tails_(tiles_of(width, height), film::TailAccumulator(capacity_of(tiles_of(width, height)))) {}

int TailStatistics::pixels_of(int tile) const {
  const int x = tile % across() * kWidth, y = tile / across() * kHeight;
  return std::min(kWidth, width_ - x) * std::min(kHeight, height_ - y);
}

void TailStatistics::add(const integrator::PixelBlock& block, std::span<const Rgb> radiance, film::Film& film) {
  const uint32_t before = film.samples(block.x, block.y);
  const double per_sample = 1 / std::max(1.0, static_cast<double>(before));
  // The mean before is uncertain too: this gives deviations the variance of a sample (Welford 1962).
  const double scale = std::sqrt(before / (before + 1.0));
  std::array<float, integrator::PixelBlock::kMostPixels> deviations;
  double sum = 0;
  size_t i = 0;
  for (int y = block.y; y < block.y + block.height; ++y) {
    const auto* pixel = &film.pixels()[static_cast<size_t>(y) * static_cast<size_t>(width_)];
    for (int x = block.x; x < block.x + block.width; ++x, ++i) {
      const double expected = luminance_of(pixel[x]) * per_sample;
      const bool counts = film.add(x, y, block.sample % film::kHalfBuffers, radiance[i]);
      const double found = counts ? static_cast<double>(luminance(radiance[i])) : 0;
      deviations[i] = static_cast<float>((found - expected) * scale);
      sum += found;
    }
  }
  if (before < kFirstWatched) return;
  const int tile = block.y / kHeight * across() + block.x / kWidth;
  tails_[static_cast<size_t>(tile)].add(std::span(deviations).first(i), sum);
}

void TailStatistics::clear() {
  for (auto& tail : tails_) tail.clear();
}

size_t TailStatistics::memory(int width, int height) {
  const size_t tiles = tiles_of(width, height);
  return tiles * (sizeof(film::TailAccumulator) + capacity_of(tiles) * sizeof(float));
}

}  // namespace etendue::render
