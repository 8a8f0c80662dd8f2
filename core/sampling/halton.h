// Scrambled Halton points.                                                     thesis 7.2.1, S59, S64
//
// Dimension j is the radical inverse in the j-th prime b, scrambled anew for every pixel: each digit is permuted, and
// how depends on the digits before it (nested), so that any b^k successive points of a dimension are stratified into
// b^k intervals. The permutations are the affine ones, a d + c mod b (Matousek 1998): uniform on pairs of digits, hence
// with the variance of Owen's scrambling, at the price of a hash a digit. Dimension 0 is Owen's own in base 2.
//
// Progressive. Bad at: high dimensions, whose large primes need many samples before pairs of dimensions are evenly
// filled; with fewer samples than the prime they lie on lines, whose slope differs from pixel to pixel. Beyond 64
// dimensions the first eight are used again for each block, with the samples in an order of their own. Costs some
// twenty times what sobol does.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

class HaltonSampler final : public Sampler {
 public:
  static constexpr const char* kName = "halton";
  static constexpr const char* kLabel = "Halton, scrambled";
  static constexpr const char* kDoc = "Radical inverses in prime bases, digits scrambled; weak in high dimensions";
  static constexpr uint32_t kDimensions = 64;
  auto knobs() { return std::tie(); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;

  // Without scrambling: the digits of `sample` in this base, mirrored at the point.
  static double radical_inverse(uint32_t sample, uint32_t base);
};

}  // namespace etendue
