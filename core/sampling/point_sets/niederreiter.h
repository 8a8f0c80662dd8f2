// Niederreiter sequence in base 2                                         [Niederreiter 1988; Bratley et al. 1992]
//
// A digital (t, s)-sequence whose generator matrices are the Laurent series of x^k / p(x)^q for the irreducible
// polynomials p over the field of two elements, in the order of their degrees; nested (Owen) scrambling, independent for
// every pixel. Each block of dimensions after the first 64 reuses the first eight dimensions with its own order of
// samples.
//
//   Properties    t is the sum of the degrees less one; the first two dimensions have t = 0, and so has every dimension by
//                 itself, because k decreases from row to row. Progressive.
//   Cost          about ten times that of `sobol`
//   Limitations   Pairs of late dimensions while samples are few; t grows faster than in the sequence of `sobol`, whose
//                 numbers are optimised for such pairs.
#pragma once
#include "sampling/sampler.h"
#include "sampling/scrambling.h"

namespace etendue {

class NiederreiterSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "niederreiter",
      .label = "Niederreiter",
      .doc = "A scrambled digital sequence in base 2. For comparison with sobol.",
      .for_study = true,
      .joint_dimensions = 64,
      .padding = "blocks of the first eight dimensions, each in an order of samples of its own",
  };
  static constexpr uint32_t kDimensions = 64;
  Choice<Scrambling> scrambling = scrambling_parameter();
  auto parameters() { return std::tie(scrambling); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;

  // The unscrambled coordinate as a fraction of 32 bits; the highest bit has the value 1/2.
  static uint32_t point(uint32_t sample, uint32_t dimension);
};

}  // namespace etendue
