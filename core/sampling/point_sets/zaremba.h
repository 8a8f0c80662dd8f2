// Zaremba sequence                                                                   [Lang, sec. 7.2.3, eq. 7.48-7.49]
//
// Psi_b(i) is the radical inverse of i in base b with digit j replaced by (a_j + j) modulo b; this includes the zeros
// after the last digit. Two-dimensional decisions take (Psi_2, Psi_3), one-dimensional ones Psi_2, each with its own
// order of samples and moved by a random offset modulo 1 (Cranley-Patterson rotation).
//
//   Properties    Progressive. Less correlation between the bases than in the Halton sequence without scrambling.
//   Limitations   Nested scrambling (`halton`, `sobol`) gives a smaller variance.
#pragma once
#include "sampling/owen.h"
#include "sampling/point_group.h"

namespace etendue {

class ZarembaSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "zaremba",
      .label = "Zaremba",
      .doc = "Radical inverses with rotated digits in bases 2 and 3. For comparison with halton.",
      .for_study = true,
      .joint_dimensions = 2,
      .padding = "independent orders of samples for each decision of a path",
  };
  auto parameters() { return std::tie(); }

  // To 53 bits.
  static double inverse(uint32_t sample, uint32_t base) {
    double sum = 0, weight = 1;
    for (uint32_t j = 0; weight > 0x1p-53; ++j) {
      weight /= base;
      sum += weight * ((sample % base + j) % base);
      sample /= base;
    }
    return std::min(sum, 1 - 0x1p-53);
  }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const uint32_t seed = hash_combine(pixel_seed, block);
    // The order of samples is shuffled by a nested permutation, which maps aligned groups of 2^k samples to such groups.
    const auto shuffled = [&](uint32_t k) { return owen_scramble(sample, mix_bits(seed + k + 1)); };
    for (uint32_t k = 0; k < 4; k += 2) {
      const uint32_t index = shuffled(k);
      out[k] = rotated(inverse(index, 2), hash_combine(seed, k));
      out[k + 1] = rotated(inverse(index, 3), hash_combine(seed, k + 1));
    }
    for (uint32_t k = 4; k < kBlockSize; ++k) out[k] = rotated(inverse(shuffled(k), 2), hash_combine(seed, k));
  }
};

}  // namespace etendue
