// Orthogonal array sampling of strength 2                     [Lang, sec. 6.5.3, eq. 6.513-6.514; Bose 1938; Tang 1993]
//
// For a prime b, the rows (i, j, i + j, i + 2 j, ..., i + (b - 1) j) modulo b form an orthogonal array of b^2 rows and
// b + 1 columns: in any two columns, each pair of symbols occurs once. The symbols of every column are permuted at
// random. The b samples with the same symbol are stratified again, so that every dimension by itself is a Latin
// hypercube.
//
//   Properties    Every pair of the eight dimensions of a block is stratified into b x b cells, and every dimension into
//                 b^2 intervals. The variance of interactions of three and more dimensions remains.
//   Limitations   The group size is the square of a prime.
#pragma once
#include "sampling/point_group.h"

namespace etendue {

class OrthogonalArraySampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "orthogonal-array",
      .label = "Orthogonal array",
      .doc = "All pairs of the dimensions of a block are stratified.",
      .progressive = false,
      .for_study = true,
      .joint_dimensions = 8,
      .padding = "an array of its own for each block of eight dimensions",
  };
  Number<int> symbols{"symbols",
                      "Symbols",
                      7,
                      {7, 61},
                      "Strata per dimension of a pair; the next prime is used. A group of samples has its square."};
  auto parameters() { return std::tie(symbols); }

  static constexpr uint32_t next_prime(uint32_t n) {
    for (;; ++n) {
      uint32_t divisor = 2;
      while (divisor * divisor <= n && n % divisor != 0) ++divisor;
      if (divisor * divisor > n) return n;
    }
  }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const uint32_t b = next_prime(static_cast<uint32_t>(symbols.value)), size = b * b;
    const GroupMember member = group_member(pixel_seed, sample, block, size);
    const uint32_t row = permutation_element(member.index, size, mix_bits(member.seed)), i = row / b, j = row % b;
    for (uint32_t k = 0; k < kBlockSize; ++k) {
      const uint32_t symbol = k == 1 ? j : (i + (k > 1 ? k - 1 : 0) * j) % b;
      // Rows with the same symbol differ in j, and in the column of j they differ in i.
      const uint32_t other = k == 1 ? i : j, seed = mix_bits(member.seed + k + 1);
      const uint32_t stratum = permutation_element(symbol, b, seed),
                     part = permutation_element(other, b, hash_combine(seed, symbol));
      out[k] = jittered(stratum * b + part, size, to_unit_float(hash_combine(seed, b + row)));
    }
  }
};

}  // namespace etendue
