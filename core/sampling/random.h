// Independent uniform random numbers
//
// Counter-based: a number is a hash of pixel, sample and dimension.
//
//   Properties    The error decreases as N^(-1/2) for N samples, for any integrand in any dimension. The reference to
//                 which other samplers are compared.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

class RandomSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "random",
      .label = "Random",
      .doc = "Independent numbers. The error decreases with the square root of the number of samples.",
      .independent = true,
      .joint_dimensions = 0,
      .padding = "independent random numbers",
  };
  auto parameters() { return std::tie(); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
};

}  // namespace etendue
