#include "sampling/sobol.h"

#include <algorithm>
#include <bit>

#include "sampling/owen.h"
#include "sampling/sobol_numbers.h"

namespace etendue {
namespace {

constexpr uint32_t kBits = 32;
using Matrix = std::array<uint32_t, kBits>;  // columns

// Bratley and Fox 1988: the recurrence of the polynomial continues the initial numbers.
constexpr Matrix direction_numbers(uint32_t dimension) {
  Matrix v{};
  if (dimension == 0) {
    for (uint32_t k = 0; k < kBits; ++k) v[k] = 1U << (kBits - 1 - k);
    return v;
  }
  const SobolNumbers& numbers = kSobolNumbers[dimension - 1];
  const auto degree = static_cast<uint32_t>(std::bit_width(numbers.polynomial)) - 1;
  for (uint32_t k = 0; k < kBits; ++k) {
    if (k < degree) {
      v[k] = numbers.initial[k] << (kBits - 1 - k);
      continue;
    }
    v[k] = v[k - degree] ^ (v[k - degree] >> degree);
    for (uint32_t i = 1; i < degree; ++i)
      if (numbers.polynomial >> (degree - i) & 1U) v[k] ^= v[k - i];
  }
  return v;
}

// Bit by bit, what it adds to every dimension, in reversed order: a point is then a sum of rows.
using Rows = std::array<std::array<uint32_t, SobolSampler::kDimensions>, kBits>;

constexpr Rows reversed_rows() {
  Rows rows{};
  for (uint32_t d = 0; d < SobolSampler::kDimensions; ++d) {
    const Matrix matrix = direction_numbers(d);
    for (uint32_t k = 0; k < kBits; ++k) rows[k][d] = reverse_bits(matrix[k]);
  }
  return rows;
}

constexpr Rows kRows = reversed_rows();

using Reversed = std::array<uint32_t, kBlockSize>;

Reversed reversed_point(uint32_t sample, uint32_t first_dimension) {
  Reversed x{};
  for (; sample != 0; sample &= sample - 1) {
    const uint32_t* row = &kRows[static_cast<size_t>(std::countr_zero(sample))][first_dimension];
    for (size_t i = 0; i < x.size(); ++i) x[i] ^= row[i];
  }
  return x;
}

// Scrambles a block of reversed points, each dimension with a seed of its own. The seeds are hashed one by one: seeds
// in an arithmetic progression tie the dimensions together, which shows as 4 % errors in parts of a Cornell box at 256
// samples. Whole numbers only: every instruction set gives the same bits, and wide ones take the block at once.
[[gnu::always_inline]] inline void scramble(const uint32_t* reversed, uint32_t seed, float* out) {
  for (uint32_t i = 0; i < kBlockSize; ++i) {
    const uint32_t x = owen_scramble_reversed(reversed[i], mix_bits(seed + i * 0x9e3779b9U));
    out[i] = static_cast<float>(static_cast<int32_t>(reverse_bits(x) >> 8)) * 0x1p-24f;
  }
}

[[gnu::target("avx2")]] void scramble_wide(const uint32_t* reversed, uint32_t seed, float* out) {
  scramble(reversed, seed, out);
}

void scramble_narrow(const uint32_t* reversed, uint32_t seed, float* out) { scramble(reversed, seed, out); }

// Chosen when the program starts, not by the linker: its resolvers run before a thread sanitizer is ready.
const auto scramble_block = __builtin_cpu_supports("avx2") ? scramble_wide : scramble_narrow;

}  // namespace

uint32_t SobolSampler::point(uint32_t sample, uint32_t dimension) {
  return reverse_bits(reversed_point(sample, dimension / kBlockSize * kBlockSize)[dimension % kBlockSize]);
}

void SobolSampler::prepare(uint32_t first, uint32_t count) {
  first_ = first;
  table_.resize(count);
  for (uint32_t s = 0; s < count; ++s)
    for (uint32_t d = 0; d < kDimensions; d += kBlockSize) {
      const Reversed x = reversed_point(first + s, d);
      std::copy(x.begin(), x.end(), &table_[s][d]);
    }
}

void SobolSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const uint32_t seed = hash_combine(pixel_seed, block);
  constexpr uint32_t kBlocks = kDimensions / kBlockSize;
  if (block < kBlocks && sample - first_ < table_.size()) {
    scramble_block(&table_[sample - first_][block * kBlockSize], seed, out.data());
    return;
  }
  if (block < kBlocks) {
    scramble_block(reversed_point(sample, block * kBlockSize).data(), seed, out.data());
    return;
  }
  // The order of samples must not share the seed of a dimension.
  const uint32_t shuffled = owen_scramble(sample, mix_bits(~seed));
  scramble_block(reversed_point(shuffled, 0).data(), seed, out.data());
}

}  // namespace etendue
