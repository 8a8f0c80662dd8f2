// The tails of the samples' distribution in each tile of an image, collected while a film is sampled.
//
// The luminance of a sample is compared with the mean of the earlier samples of its pixel, so that bright pixels
// without variance (a sun that is seen directly) are not tails. The first two samples of a pixel are not used, because
// there is no mean to compare them with. A tile is filled by one thread at a time, sample by sample, so the statistics
// have the same bits for any number of threads.
#pragma once
#include <span>
#include <vector>

#include "film/film.h"
#include "film/tail.h"
#include "integrator/pixel_block.h"

namespace etendue::render {

class TailStatistics {
 public:
  static constexpr int kWidth = integrator::PixelBlock::kWidth, kHeight = integrator::PixelBlock::kHeight;

  TailStatistics() = default;
  TailStatistics(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  int columns() const { return (width_ + kWidth - 1) / kWidth; }  // of tiles
  int rows() const { return (height_ + kHeight - 1) / kHeight; }
  int pixels_of(int tile) const;

  // Adds a block to the film, and the deviations of its samples to the statistics of its tile.
  void add(const integrator::PixelBlock& block, std::span<const Rgb> radiance, film::Film& film);

  // One per tile, row by row from the top.
  const std::vector<film::TailAccumulator>& tails() const { return tails_; }
  void clear();

  // The states of all tiles, and back. The number of states must be that of the tiles.
  std::vector<film::TailState> states() const;
  void restore(std::span<const film::TailState> states);
  // Of the accumulators of an image of this size.
  static size_t capacity(int width, int height);
  static size_t tile_count(int width, int height);

  // The largest number of bytes that the statistics of an image take.
  static size_t memory(int width, int height);

 private:
  int width_ = 0, height_ = 0;
  std::vector<film::TailAccumulator> tails_;
};

}  // namespace etendue::render
