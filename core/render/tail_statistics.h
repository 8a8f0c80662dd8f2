// The tails of what the pixels of each tile have gathered: where the samples of a rendering are watched.
//
// A sample's luminance is compared with the mean of its pixel before it, so that what is bright but certain (a sun in
// the sky, seen directly) is no tail. The first two samples of a pixel have nothing to be compared with, and are left
// out. One thread at a time fills a tile, sample by sample: the tails have the same bits whatever the number of
// threads.
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
  int across() const { return (width_ + kWidth - 1) / kWidth; }
  int down() const { return (height_ + kHeight - 1) / kHeight; }
  int pixels_of(int tile) const;

  // Adds a block to the film and what is unexpected about it to the tail of its tile.
  void add(const integrator::PixelBlock& block, std::span<const Rgb> radiance, film::Film& film);

  const std::vector<film::TailAccumulator>& tails() const { return tails_; }
  void clear();
  // Bytes that the tails of a picture take at most.
  static size_t memory(int width, int height);

 private:
  int width_ = 0, height_ = 0;
  std::vector<film::TailAccumulator> tails_;
};

}  // namespace etendue::render
