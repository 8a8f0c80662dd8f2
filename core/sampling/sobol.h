// Sobol' sequence with Owen scrambling                                       [Lang, sec. 7.2.4-7.3.3; Owen 1995]
//
// A (t, s)-sequence in base 2 with the direction numbers of [Joe and Kuo 2008] in 64 dimensions, scrambled
// independently for every pixel. Each block of dimensions after the first 64 reuses the first eight dimensions with its
// own order of samples (padding): the same nets within a block, independent between blocks.
//
//   Properties    Any aligned group of 2^m samples is a (0, m, 1)-net in each dimension and a (0, m, 2)-net in the
//                 first two dimensions; pairs of neighbouring dimensions have t <= 6 for 1024 samples. Unbiased and
//                 progressive. For smooth integrands of few dimensions the error decreases faster than 1/N; for large N
//                 it is never worse than that of random numbers.
//   Cost          One hash per dimension. All pixels share the unscrambled point of a sample, which `prepare`
//                 tabulates. Samples outside of the table have the same values at about three times the cost.
//   Limitations   Less effective for sample counts far from powers of two, and for pairs of late dimensions while
//                 samples are few.
#pragma once
#include "sampling/sampler.h"
#include "sampling/scrambling.h"

namespace etendue {

class SobolSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "sobol",
      .label = "Sobol'",
      .doc = "Scrambled low-discrepancy points. In smooth regions the error decreases faster than with random numbers.",
      .joint_dimensions = 64,
      .padding = "blocks of the first eight dimensions, each in an order of samples of its own",
  };
  static constexpr uint32_t kDimensions = 64;
  Choice<Scrambling> scrambling = scrambling_parameter();
  auto parameters() { return std::tie(scrambling); }

  void prepare(uint32_t first, uint32_t count) override;
  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
  DimensionSet blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block, DimensionSet requested,
                      SampleTable& out) const override;

  // The unscrambled coordinate as a fraction of 32 bits; the highest bit has the value 1/2.
  static uint32_t point(uint32_t sample, uint32_t dimension);

  // A block of coordinates with reversed bits.
  using Reversed = std::array<uint32_t, kBlockSize>;

 private:
  static constexpr uint32_t kBlocks = kDimensions / kBlockSize;
  Reversed reversed(uint32_t sample, uint32_t block) const;

  // Coordinates of the samples first_, first_ + 1, ... with reversed bits.
  uint32_t first_ = 0;
  std::vector<std::array<uint32_t, kDimensions>> table_;
};

}  // namespace etendue
