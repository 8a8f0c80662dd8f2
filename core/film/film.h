// The film: accumulation of samples in double precision, in two independent half-buffers
//
// The samples of a pixel alternate between the half-buffers, which use different random numbers. The mean of both is the
// image. Their difference measures the error, also for quasi-Monte Carlo points, where the variance within a sequence
// does not: Var(mean) = (A - B)^2 / 4 per pixel in expectation, for the means A and B of the half-buffers.
//
// The half-buffers are weighted by their numbers of samples. With adaptive sampling, where these numbers depend on the
// samples, both have the weight 1/2, because other weights would bias the mean.
//
// Sums are exact (film/rounding_errors.h): means do not depend on the order in which samples were added, nor on how
// the rendering was divided into parts.
//
// Invalid samples (not a finite radiance, or negative where that is not allowed) are counted and contribute the value
// zero.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/error_free.h"
#include "base/vec.h"
#include "film/error.h"
#include "film/half_buffers.h"
#include "film/invalid_samples.h"
#include "film/rounding_errors.h"
#include "film/tile_variance.h"
#include "spectrum/rgb.h"

namespace etendue::film {

class Film {
 public:
  Film() = default;
  Film(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  // Whether negative samples are valid: those of estimators with control variates. By default they are not.
  void allow_negative_samples(bool allow) { allows_negative_samples_ = allow; }

  struct Pixel {
    std::array<std::array<double, 3>, kHalfBuffers> sum{};  // rounded after each sample
    std::array<uint32_t, kHalfBuffers> count{};
  };

  // Whether a sample is valid. Others count as zero.
  bool accepts(const Rgb& radiance) const {
    return is_radiance(radiance) || (allows_negative_samples_ && is_finite(radiance));
  }
  // Adds one sample to a half-buffer of a pixel; returns false if it is invalid. Different pixels may be updated from
  // different threads.
  bool add(int x, int y, uint32_t half_buffer, const Rgb& radiance) {
    return add(at(x, y), x, y, half_buffer, radiance);
  }
  // The same, where `pixel` is the pixel at (x, y).
  bool add(Pixel& pixel, int x, int y, uint32_t half_buffer, const Rgb& radiance) {
    if (!accepts(radiance)) [[unlikely]] {
      invalid_.count(x, y, sample_index(half_buffer, pixel.count[half_buffer]), radiance);
      // Counts as a sample of value zero. Leaving it out would bias the mean towards the valid samples.
      ++pixel.count[half_buffer];
      return false;
    }
    ++pixel.count[half_buffer];
    auto& sum = pixel.sum[half_buffer];
    Double2 red_green{sum[0], sum[1]};
    const Double2 error = add_exactly(red_green, Double2{double{radiance.r}, double{radiance.g}});
    const double blue_error = add_exactly(sum[2], double{radiance.b});
    sum[0] = red_green[0];
    sum[1] = red_green[1];
    const auto is_rounded =
        std::bit_cast<uint64_t>(error[0]) | std::bit_cast<uint64_t>(error[1]) | std::bit_cast<uint64_t>(blue_error);
    if (is_rounded != 0) [[unlikely]]
      errors_.add(x, y, half_buffer, {error[0], error[1], blue_error});
    return true;
  }

  // Adds `count` samples of one half-buffer that have this sum. It may be one of several terms of their sum, the others
  // with a count of 0.
  void add_sum(int x, int y, uint32_t half_buffer, const std::array<double, 3>& sum, uint32_t count);

  uint32_t samples(int x, int y) const;
  uint32_t half_buffer_samples(int x, int y, uint32_t half_buffer) const { return at(x, y).count[half_buffer]; }
  // The exact sum of a half-buffer, rounded.
  std::array<double, 3> sum(int x, int y, uint32_t half_buffer) const {
    Sums buffer;
    return sums(x, y, buffer)[half_buffer];
  }
  Rgb mean(int x, int y) const;
  // The mean of one half-buffer, which must have a sample in this pixel.
  Rgb half_buffer_mean(int x, int y, uint32_t half_buffer) const;
  // The squared standard error of `mean` per channel; zero if a half-buffer has no sample in this pixel.
  Rgb variance_of_mean(int x, int y) const;

  // The estimated error of the image (film/error.h).
  ErrorEstimate error() const;
  // The same computed by rows, which may be done in parallel.
  RowError error_of_row(int y) const;
  ErrorEstimate error(std::span<const RowError> rows) const;
  InvalidSamples invalid_samples() const { return invalid_.get(); }

  // The number of the first sample of each pixel; 0 unless the film holds a part of a rendering.
  void set_first_sample(uint32_t sample) { first_sample_ = sample; }

  // The complete state, for checkpoints, together with `rounding_errors`.
  std::span<const Pixel> pixels() const { return pixels_; }
  std::span<Pixel> pixels() { return pixels_; }
  const RoundingErrors& rounding_errors() const { return errors_; }
  RoundingErrors& rounding_errors() { return errors_; }
  void set_invalid_samples(const InvalidSamples& samples) { invalid_.set(samples); }

  // The sample variance of tiles, for adaptive sampling; not present until `begin_tile_variance` is called.
  void begin_tile_variance(size_t tiles) { tile_variance_.emplace(tiles); }
  std::optional<TileVariance>& tile_variance() { return tile_variance_; }
  const std::optional<TileVariance>& tile_variance() const { return tile_variance_; }

  // Resets the pixels of the rows [first, end).
  void clear_rows(int first, int end);
  // In bytes, of the pixels.
  size_t memory() const { return pixels_.size() * sizeof(Pixel) + errors_.memory(); }

 private:
  const Pixel& at(int x, int y) const {
    return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }
  Pixel& at(int x, int y) {
    return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }

  using Sums = std::array<std::array<double, 3>, kHalfBuffers>;
  // The exact sums of a pixel, rounded: those of the pixel, or, if they had been rounded, `buffer`.
  const Sums& sums(int x, int y, Sums& buffer) const {
    return errors_.any_at(x, y) ? rounded_sums(x, y, buffer) : at(x, y).sum;
  }
  const Sums& rounded_sums(int x, int y, Sums& buffer) const;
  Rgb mean(const Pixel& p, const Sums& sum) const;
  Rgb variance_of_mean(const Pixel& p, const Sums& sum) const;

  // The number of sample `n` of a half-buffer.
  uint32_t sample_index(uint32_t half_buffer, uint32_t n) const {
    return (n + (first_sample_ + 1 - half_buffer) / kHalfBuffers) * kHalfBuffers + half_buffer;
  }
  bool has_equal_weights(const Pixel& p) const { return tile_variance_ && p.count[0] > 0 && p.count[1] > 0; }

  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
  RoundingErrors errors_;
  uint32_t first_sample_ = 0;
  bool allows_negative_samples_ = false;
  std::optional<TileVariance> tile_variance_;
  InvalidSampleCounter invalid_;
};

}  // namespace etendue::film
