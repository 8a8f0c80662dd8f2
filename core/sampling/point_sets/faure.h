// Faure sequence in base 11                                         [Lang, sec. 7.2.4; Faure 1982]
//
// A (0, 11)-sequence, of which a block takes eight dimensions: the digits of the sample number are multiplied by powers
// of the Pascal matrix modulo 11. Every digit is moved by a random digit (digital shift) that is independent for every
// pixel and dimension. Each block has its own order of samples.
//
//   Properties    Any 11^m successive samples of a block, in the order of the sequence, are a (0, m, 8)-net in base 11:
//                 every elementary interval of volume 11^-m contains one point. Progressive.
//   Cost          about fifty times that of `sobol`
//   Limitations   The base is large: pairs of dimensions are stratified by 121 samples and more.
#pragma once
#include "sampling/owen.h"
#include "sampling/point_group.h"

namespace etendue {

class FaureSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "faure",
      .label = "Faure",
      .doc = "A digital sequence in base 11 in which all dimensions of a block are alike. Needs many samples.",
      .for_study = true,
  };
  static constexpr uint32_t kBase = 11, kDigits = 10;  // more than the digits of 2^32
  auto parameters() { return std::tie(); }

  // The digits of a coordinate, the most significant one first. `dimension` is less than kBase.
  using Digits = std::array<uint32_t, kDigits>;
  static Digits point(uint32_t sample, uint32_t dimension) {
    Digits digits{};
    // Column j of the matrix has the elements binomial(j, i) dimension^(j - i); it follows from the column before.
    Digits column{1};
    for (uint32_t j = 0; j < kDigits; ++j) {
      const uint32_t digit = sample % kBase;
      sample /= kBase;
      for (uint32_t i = 0; i <= j; ++i) digits[i] = (digits[i] + column[i] * digit) % kBase;
      for (uint32_t i = j + 1; i > 0; --i)
        if (i < kDigits) column[i] = (column[i] * dimension + column[i - 1]) % kBase;
      column[0] = column[0] * dimension % kBase;
    }
    return digits;
  }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const uint32_t seed = hash_combine(pixel_seed, block), index = owen_scramble(sample, mix_bits(seed));
    for (uint32_t k = 0; k < kBlockSize; ++k) {
      uint64_t random = mix_bits(uint64_t{hash_combine(seed, k)} << 32 | seed);
      double x = 0, weight = 1;
      for (const uint32_t digit : point(index, k)) {
        weight /= kBase;
        x += weight * ((digit + static_cast<uint32_t>((random >> 32) * kBase >> 32)) % kBase);
        random = mix_bits(random + 0x9e3779b97f4a7c15ULL);
      }
      out[k] = std::min(static_cast<float>(x), kOneMinusEpsilon);
    }
  }
};

}  // namespace etendue
