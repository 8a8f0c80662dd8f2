// Hammersley point set in base 2                                             [Lang, sec. 7.2.2, eq. 7.41 and 7.50]
//
// Each two-dimensional decision of a group of N = 2^m samples takes the points (i / N, Phi_2(i)), where Phi_2 is the
// radical inverse, in one of four randomisations. For fixed-size sets see sampling/point_group.h.
//
//   Properties    A (0, m, 2)-net: every elementary interval of area 1 / N contains one point. Nested (Owen) scrambling
//                 and digital shifts keep this property, rotation does not. Nested scrambling gives the smallest
//                 variance, of order N^-3 for smooth integrands; jitter, after a digital shift of the m digits, turns
//                 aliasing into noise.
//   Limitations   The number of samples is fixed: a finer set does not contain a coarser one.
#pragma once
#include "sampling/point_group.h"
#include "sampling/scrambling.h"

namespace etendue {

// The values of Scrambling in their order, and jitter.
enum class HammersleyScrambling { owen, digital_shift, rotation, none, jitter };

}  // namespace etendue

template <>
struct etendue::Options<etendue::HammersleyScrambling> {
  static constexpr std::array<etendue::Option, 5> kOptions{{{"owen", "Nested (Owen)"},
                                                            {"digital-shift", "Digital shift"},
                                                            {"rotation", "Rotation (Cranley-Patterson)"},
                                                            {"none", "None"},
                                                            {"jitter", "Jitter"}}};
};

namespace etendue {

class HammersleySampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "hammersley",
      .label = "Hammersley",
      .doc = "Low-discrepancy sets of a fixed size, with a choice of randomisations.",
      .progressive = false,
      .for_study = true,
      .joint_dimensions = 2,
      .padding = "independent orders of samples for each decision of a path",
  };
  Number<int> log2_size{
      "log2-size", "Group size, log2", 6, {0, 16}, "A group has this power of two of samples: 6 stands for 64."};
  Choice<HammersleyScrambling> scrambling{"scrambling", "Scrambling", HammersleyScrambling::owen,
                                          "Randomisation of the points in a group. none: the same set in every group, for study"};
  auto parameters() { return std::tie(log2_size, scrambling); }

  // A point as fractions of 32 bits, without randomisation.
  static std::array<uint32_t, 2> point(uint32_t i, int log2_size) {
    return {log2_size > 0 ? i << (32 - log2_size) : 0, reverse_bits(i)};
  }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const uint32_t size = 1U << log2_size.value;
    fill_from_group(group_member(pixel_seed, sample, block, size), size, out, [&](uint32_t i, uint32_t seed) {
      const auto p = point(i, log2_size);
      return std::array{randomised(p[0], i, seed), randomised(p[1], i, hash_combine(seed, 1))};
    });
  }

 private:
  float randomised(uint32_t x, uint32_t i, uint32_t seed) const {
    const uint32_t random = mix_bits(seed);
    if (scrambling != HammersleyScrambling::jitter)
      return to_unit_float(scramble(static_cast<Scrambling>(scrambling.value), x, random));
    const uint32_t below = log2_size > 0 ? 0xffffffffU >> log2_size : 0xffffffffU;  // the digits after the first m
    return to_unit_float(((x ^ random) & ~below) | (hash_combine(random, i + 1) & below));
  }
};

}  // namespace etendue
