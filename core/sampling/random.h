// Independent uniform numbers.
//
// Counter-based: a hash of pixel, sample and dimension, so that a number depends on its name and not on when it is
// asked for. The yardstick that the others are measured against: error falls as N^(-1/2), in any dimension, for any
// integrand.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

class RandomSampler final : public Sampler {
 public:
  static constexpr const char* kName = "random";
  static constexpr const char* kLabel = "Random";
  static constexpr const char* kDoc =
      "Independent numbers; the yardstick, error falls as one over the root of the samples";
  auto knobs() { return std::tie(); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
};

}  // namespace etendue
