// Owen-scrambled Sobol' points.                                              thesis 7.2.4 to 7.3.3 (S67, S69)
//
// A (t, s)-sequence in base 2 with the direction numbers of Joe and Kuo in 64 dimensions, scrambled anew for every
// pixel. Progressive: it may stop anywhere, best at a power of two. Any aligned stretch of 2^m samples is a (0, m,
// 1)-net in each dimension and a (0, m, 2)-net in the first two; neighbouring pairs have a t of at most 6 (1024
// samples). Beyond 64 dimensions the first eight are used again for each block, in an order of samples of its own
// (padding): the same nets within a block, independent between blocks. The error of smooth integrands of few dimensions
// falls faster than 1/N; on anything it is unbiased and, as N grows, no worse than random numbers. Bad at: sample
// counts far from powers of two, pairs of late dimensions while samples are few.
//
// All pixels share the unscrambled point of a sample: `prepare` tabulates it, and a dimension costs one hash. Samples
// outside the table have the same values at some three times the cost.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

class SobolSampler final : public Sampler {
 public:
  static constexpr const char* kName = "sobol";
  static constexpr const char* kLabel = "Sobol', Owen";
  static constexpr const char* kDoc =
      "Scrambled low-discrepancy points; the error of smooth pixels falls faster than random";
  static constexpr uint32_t kDimensions = 64;
  auto knobs() { return std::tie(); }

  void prepare(uint32_t first, uint32_t count) override;
  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
  DimensionSet blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block, DimensionSet wanted,
                      SampleTable& out) const override;

  // The unscrambled coordinate as 32 bits, the highest worth one half.
  static uint32_t point(uint32_t sample, uint32_t dimension);

  // A block of coordinates, their bits reversed.
  using Reversed = std::array<uint32_t, kBlockSize>;

 private:
  static constexpr uint32_t kBlocks = kDimensions / kBlockSize;
  Reversed reversed(uint32_t sample, uint32_t block) const;

  uint32_t first_ = 0;
  std::vector<std::array<uint32_t, kDimensions>> table_;  // bits reversed
};

}  // namespace etendue
