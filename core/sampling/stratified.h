// Jittered strata.                                                             thesis 6.5.3, S38-S41
//
// Samples come in groups of n x n. Within a group the two-dimensional decisions (pixel, lens, light point, direction)
// fall one into each cell of an n x n grid, the others one into each of n^2 slices; groups, pixels and decisions are
// put together at random. An unfinished group is as good as random numbers. Variance falls by up to a factor n^2 on
// smooth integrands, but only within a group: with more samples the rate is that of random numbers again.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

class StratifiedSampler final : public Sampler {
 public:
  static constexpr const char* kName = "stratified";
  static constexpr const char* kLabel = "Stratified";
  static constexpr const char* kDoc =
      "Jittered grids, put together at random; better than random within a group of samples";
  Number<int> side{"side", "Strata per side", 4, {1, 64}, "A group of samples is the square of this"};
  auto knobs() { return std::tie(side); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
};

}  // namespace etendue
