// Latin hypercube (N rooks) sampling                               [Lang, sec. 6.5.3, eq. 6.511; McKay et al. 1979]
//
// In a group of N samples, every dimension has one sample in each of N intervals, in an independent random order.
//
//   Properties    Removes the part of the variance that is a sum of functions of one dimension each; interactions
//                 between dimensions keep the variance of random numbers. Works in any number of dimensions.
#pragma once
#include "sampling/point_group.h"

namespace etendue {

class LatinHypercubeSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "latin-hypercube",
      .label = "Latin hypercube",
      .doc = "Every dimension by itself is stratified. Helps where the dimensions act independently.",
      .progressive = false,
      .for_study = true,
      .joint_dimensions = 1,
      .padding = "independent orders of samples for each dimension",
  };
  Number<int> samples{"samples", "Group size", 16, {1, 4096}, "Number of samples that are stratified together."};
  auto parameters() { return std::tie(samples); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const auto n = static_cast<uint32_t>(samples.value);
    const GroupMember member = group_member(pixel_seed, sample, block, n);
    for (uint32_t k = 0; k < kBlockSize; ++k) out[k] = jittered_interval(member, k, n);
  }
};

}  // namespace etendue
