// Progressive multi-jittered (0,2) sequences       [Christensen et al. 2018; Helmer et al. 2021; Ahmed 2024; Owen 1995]
//
// Each two-dimensional decision of a block (dimensions 0-1 and 2-3) takes its own sequence: the first two dimensions of
// the Sobol' sequence with nested (Owen) scrambling, in an order of its own. These are progressive multi-jittered
// sequences: every prefix of 2^m samples is stratified in all elementary intervals, at a random position in each. Each
// one-dimensional decision takes a scrambled van der Corput sequence in an order of its own.
//
//   Properties    The samples of each decision are a (0, 2)-sequence in base 2, so that t = 0 for every aligned group of
//                 2^m samples of every decision, at any depth of a path. Progressive.
//   Cost          about that of `sobol`, without tables
//   Limitations   Decisions are combined at random: an integrand that depends on several decisions at once, like the
//                 pixel and the light point together, gains less than with `sobol` while paths are short.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

class Pmj02Sampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "pmj02",
      .label = "Multi-jittered (0,2)",
      .doc =
          "A progressive multi-jittered (0,2) sequence for each decision of a path. As good at late decisions as at "
          "early ones.",
      .joint_dimensions = 2,
      .padding = "independent orders of samples for each decision of a path",
  };
  auto parameters() { return std::tie(); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
  DimensionSet blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block, DimensionSet requested,
                      SampleTable& out) const override;
};

}  // namespace etendue
