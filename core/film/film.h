// Where samples are gathered: sums in double, in two independent halves.
//
// Samples alternate between the halves, and each half has its own random numbers. The mean of both is the image; their
// difference is its error, also for quasi-Monte Carlo points, whose spread inside one sequence says nothing:
// Var(mean) = (A - B)^2 / 4 per pixel, in expectation. Halves weigh by their numbers of samples, unless these numbers
// were chosen by what samples are: then both weigh the same. What is not a finite, non-negative radiance is counted and
// left out.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "film/error.h"
#include "film/invalid_samples.h"
#include "film/tile_variance.h"
#include "spectrum/rgb.h"

namespace etendue::film {

inline constexpr uint32_t kHalfBuffers = 2;

class Film {
 public:
  Film() = default;
  Film(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  // Adds one sample to a pixel; false if it was rejected. Different pixels may be added to from different threads.
  bool add(int x, int y, uint32_t half_buffer, const Rgb& radiance) {
    Pixel& pixel = at(x, y);
    if (!is_radiance(radiance)) [[unlikely]] {
      rejected_.count(x, y, pixel.count[half_buffer] * kHalfBuffers + half_buffer, radiance);
      // It counts as a sample of value zero: leaving it out would favour what cannot be computed.
      ++pixel.count[half_buffer];
      return false;
    }
    ++pixel.count[half_buffer];
    auto& sum = pixel.sum[half_buffer];
    sum[0] += radiance.r, sum[1] += radiance.g, sum[2] += radiance.b;
    return true;
  }

  uint32_t samples(int x, int y) const;
  uint32_t half_buffer_samples(int x, int y, uint32_t half_buffer) const { return at(x, y).count[half_buffer]; }
  Rgb mean(int x, int y) const;
  // Of one half; it must have a sample there.
  Rgb half_buffer_mean(int x, int y, uint32_t half_buffer) const;
  // The standard error of `mean`, squared, per channel; zero while a half is empty.
  Rgb variance_of_mean(int x, int y) const;

  ErrorEstimate error() const;
  // The same in pieces.
  RowError error_of_row(int y) const;
  ErrorEstimate error(std::span<const RowError> rows) const;
  InvalidSamples invalid_samples() const { return rejected_.get(); }

  // Everything the film knows, for checkpoints.
  struct Pixel {
    std::array<std::array<double, 3>, kHalfBuffers> sum{};
    std::array<uint32_t, kHalfBuffers> count{};
  };
  std::span<const Pixel> pixels() const { return pixels_; }
  std::span<Pixel> pixels() { return pixels_; }
  void set_invalid_samples(const InvalidSamples& rejected) { rejected_.set(rejected); }

  // For adaptive sampling in blocks of pixels. Without it, nothing is kept of how samples scatter.
  void begin_tile_variance(size_t blocks) { spread_.emplace(blocks); }
  std::optional<TileVariance>& tile_variance() { return spread_; }
  const std::optional<TileVariance>& tile_variance() const { return spread_; }

  // Empties the pixels of some rows.
  void clear_rows(int first, int end);
  size_t memory() const { return pixels_.size() * sizeof(Pixel); }

 private:
  const Pixel& at(int x, int y) const {
    return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }
  Pixel& at(int x, int y) {
    return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }

  bool halves_weigh_the_same(const Pixel& p) const { return spread_ && p.count[0] > 0 && p.count[1] > 0; }

  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
  std::optional<TileVariance> spread_;
  InvalidSampleCounter rejected_;
};

}  // namespace etendue::film
