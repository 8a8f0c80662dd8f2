// Adaptive sampling without bias: how many samples each block of pixels receives.
//
// Sampling proceeds in rounds. In round p every pixel first receives 2^p samples in each half-buffer. The same number
// of samples, on average, is then distributed over blocks of pixels in proportion to their standard deviations, which
// minimises the mean squared error for a given number of samples [Neyman 1934]. If the estimated deviations are
// misleading, a block still has at least half of the samples that uniform sampling would have given it.
//
// Choosing the sample count from the same samples biases the estimate [Kirk and Arvo 1991]. Here the number of samples
// of one half-buffer depends only on the first 2^p samples of the *other* half-buffer, and the number of these is
// fixed. Given the allocation, a half-buffer is as random as without one, so its mean is unbiased. The image is the
// mean of both half-buffers with weight 1/2 each: weights proportional to the sample counts would depend on the
// samples.
#pragma once
#include <array>
#include <vector>

#include "film/tile_variance.h"
#include "render/document.h"

namespace etendue::render {

// Sample numbers [first, end), counted within a half-buffer.
struct SampleRange {
  uint32_t first = 0, end = 0;
};

class SampleAllocation {
 public:
  // `pixels` holds the number of pixels of each block.
  SampleAllocation(Adaptive goal, std::vector<int> pixels);

  // The samples that every block takes next, in each half-buffer, as far as the block's target allows.
  const SampleRange& range() const { return range_; }
  // The number of samples per pixel that a half-buffer of a block receives in the current round.
  uint32_t target(size_t block, uint32_t half) const { return targets_[block][half]; }

  // Moves on to the next range after all blocks have completed the current one.
  void advance(const film::TileVariance& variance);

 private:
  void begin_uniform();
  void begin_adaptive(const film::TileVariance& variance);
  void allocate(const film::TileVariance& variance, uint32_t half);
  double deviation(const film::TileVariance::Moments& tile) const;
  void set_range(uint32_t first);

  Adaptive goal_;
  std::vector<int> pixels_;
  double pixel_count_ = 0;
  std::vector<std::array<uint32_t, 2>> targets_;
  uint32_t largest_target_ = 0;
  int power_ = film::TileVariance::kFirstPower;  // p of the current round
  bool uniform_ = true;                          // the uniform part of the round
  SampleRange range_;
};

}  // namespace etendue::render
