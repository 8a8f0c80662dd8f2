// Faure sequence in base 11                                         [Lang, sec. 7.2.4; Faure 1982]
//
// A (0, 11)-sequence, of which a block takes eight dimensions: the digits of the sample number are multiplied by powers
// of the Pascal matrix modulo 11. Every digit is moved by a random digit (digital shift) that is independent for every
// pixel and dimension. Each block has its own order of samples.
//
//   Properties    Any 11^m successive samples of a block, in the order of the sequence, are a (0, m, 8)-net in base 11:
//                 every elementary interval of volume 11^-m contains one point. Progressive.
//   Cost          about forty times that of `sobol`
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
      .joint_dimensions = 8,
      .padding = "an order of samples of its own for each block of eight dimensions",
  };
  static constexpr uint32_t kBase = 11;
  static constexpr uint32_t kIndexDigits = 10;  // of any sample number
  static constexpr uint32_t kDigits = 7;        // of a coordinate: more than a float resolves
  auto parameters() { return std::tie(); }

  // The digits of a coordinate, the most significant one first.
  using Digits = std::array<uint32_t, kDigits>;
  static Digits point(uint32_t sample, uint32_t dimension) { return transformed(index_digits(sample), dimension); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const uint32_t seed = hash_combine(pixel_seed, block);
    const IndexDigits index = index_digits(owen_scramble(sample, mix_bits(seed)));
    for (uint32_t k = 0; k < kBlockSize; ++k) {
      uint64_t random = mix_bits(uint64_t{hash_combine(seed, k)} << 32 | seed);
      double x = 0, weight = 1;
      for (const uint32_t digit : transformed(index, k)) {
        weight /= kBase;
        x += weight * ((digit + static_cast<uint32_t>((random >> 32) * kBase >> 32)) % kBase);
        random = mix_bits(random + 0x9e3779b97f4a7c15ULL);
      }
      // The digits after the last one are random.
      x += weight * static_cast<double>(random >> 32) * 0x1p-32;
      out[k] = std::min(static_cast<float>(x), kOneMinusEpsilon);
    }
  }

 private:
  using IndexDigits = std::array<uint32_t, kIndexDigits>;  // the least significant one first
  static constexpr IndexDigits index_digits(uint32_t sample) {
    IndexDigits digits{};
    for (uint32_t& digit : digits) {
      digit = sample % kBase;
      sample /= kBase;
    }
    return digits;
  }

  // Powers of the Pascal matrix modulo the base: element (i, j) is binomial(j, i) dimension^(j - i).
  using Matrix = std::array<IndexDigits, kDigits>;
  static constexpr Matrix matrix(uint32_t dimension) {
    Matrix m{};
    m[0][0] = 1;
    for (uint32_t j = 1; j < kIndexDigits; ++j)
      for (uint32_t i = 0; i < kDigits; ++i)
        m[i][j] = (m[i][j - 1] * dimension + (i > 0 ? m[i - 1][j - 1] : 0)) % kBase;
    return m;
  }

  static Digits transformed(const IndexDigits& index, uint32_t dimension) {
    static constexpr std::array<Matrix, kBlockSize> kMatrices = [] {
      std::array<Matrix, kBlockSize> all{};
      for (uint32_t d = 0; d < kBlockSize; ++d) all[d] = matrix(d);
      return all;
    }();
    Digits digits{};
    for (uint32_t i = 0; i < kDigits; ++i) {
      for (uint32_t j = 0; j < kIndexDigits; ++j) digits[i] += kMatrices[dimension][i][j] * index[j];
      digits[i] %= kBase;
    }
    return digits;
  }
};

}  // namespace etendue
