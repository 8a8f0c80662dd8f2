// Stratified (jittered) sampling                                              [Lang, sec. 6.5.3, eq. 6.485-6.512]
//
// Samples are drawn in groups of n x n. Within a group, each two-dimensional decision (pixel, lens, light point,
// direction) has one point in each cell of an n x n grid, and each one-dimensional decision has one point in each of
// n^2 intervals. The order of cells is an independent random permutation for each group, pixel and decision.
//
//   Properties    The variance of smooth integrands decreases by up to a factor n^2 within a group. Beyond one group
//                 the convergence rate is that of `random`; an incomplete group is as good as random numbers.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

class StratifiedSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "stratified",
      .label = "Stratified",
      .doc = "Jittered grids in random order. Better than random within a group of samples.",
      .progressive = false,
      .joint_dimensions = 2,
      .padding = "independent orders of samples for each decision of a path",
  };
  Number<int> side{"side", "Strata per side", 4, {1, 64}, "A group of samples has the square of this number."};
  auto parameters() { return std::tie(side); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
};

}  // namespace etendue
