// Scrambled Halton sequence                                              [Lang, sec. 7.2.1; Owen 1995; Matousek 1998]
//
// Dimension j of sample i is the radical inverse of i in the j-th prime number b, with nested scrambling: the
// permutation of each digit depends on the digits before it, and on the pixel. The permutations are affine,
// d -> (a d + c) mod b [Matousek 1998]; they are uniform on pairs of digits and therefore give the variance of Owen
// scrambling, with one hash per digit. Dimension 0 (base 2) uses Owen scrambling. For comparison, the parameter
// `scrambling` selects the fixed permutations of [Faure 1992], or none; a random offset modulo 1 for each pixel and
// dimension (Cranley-Patterson rotation) then makes the samples unbiased.
//
//   Properties    b^k successive samples are stratified into b^k intervals of a dimension. Progressive.
//   Cost          about twenty times that of `sobol`
//   Limitations   In high dimensions the primes are large, and pairs of dimensions are evenly filled only by many
//                 samples. With fewer samples than the prime, they lie on lines, whose slope differs from pixel to
//                 pixel. Beyond 64 dimensions, every block reuses the first eight dimensions with its own order of
//                 samples.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

enum class HaltonScrambling { owen, faure, rotation };

}  // namespace etendue

template <>
struct etendue::Options<etendue::HaltonScrambling> {
  static constexpr std::array<etendue::Option, 3> kOptions{{{"owen", "Nested (Owen)"},
                                                            {"faure", "Faure permutations, rotation"},
                                                            {"rotation", "Rotation (Cranley-Patterson)"}}};
};

namespace etendue {

class HaltonSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "halton",
      .label = "Halton, scrambled",
      .doc = "Radical inverses in prime bases with scrambled digits. Weak in high dimensions.",
      .joint_dimensions = 64,
      .padding = "blocks of the first eight dimensions, each in an order of samples of its own",
  };
  static constexpr uint32_t kDimensions = 64;
  Choice<HaltonScrambling> scrambling{"scrambling", "Scrambling", HaltonScrambling::owen,
                                      "Randomisation of the digits of the sequence"};
  auto parameters() { return std::tie(scrambling); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;

  // The radical inverse without scrambling: the digits of `sample` in this base, mirrored at the radix point.
  static double radical_inverse(uint32_t sample, uint32_t base);
  // The same with the digits permuted: `permutation` has as many elements as the base, and its first one is 0.
  static double radical_inverse(uint32_t sample, std::span<const uint16_t> permutation);
  // The permutation of the digits of a base in [Faure 1992; Lang, def. 7.12].
  static std::vector<uint16_t> faure_permutation(uint32_t base);

 private:
  float rotated_inverse(uint32_t sample, uint32_t dimension, uint32_t seed) const;
};

}  // namespace etendue
