#include "sampling/stratified.h"

#include <bit>

#include "base/hash.h"
#include "sampling/permutation.h"

namespace etendue {
namespace {

// A point of interval `cell` of `cells` in [0, 1). The limit prevents that rounding moves it into the next interval.
float jittered(uint32_t cell, uint32_t cells, float jitter) {
  const auto start = static_cast<float>(cell), count = static_cast<float>(cells);
  const float below_end = std::bit_cast<float>(std::bit_cast<uint32_t>((start + 1) / count) - 1);
  return std::min((start + jitter) / count, below_end);
}

}  // namespace

void StratifiedSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const auto n = static_cast<uint32_t>(side.value), cells = n * n;
  const uint32_t group = sample / cells, member = sample % cells;
  const uint32_t seed = hash_combine(hash_combine(pixel_seed, block), group);
  const auto jitter = [&](uint32_t i) { return to_unit_float(hash_combine(seed, member * kBlockSize + i)); };
  // Dimensions 0-1 and 2-3 of every block are two-dimensional decisions.
  for (uint32_t i = 0; i < 4; i += 2) {
    const uint32_t cell = permutation_element(member, cells, mix_bits(seed + i + 1));
    out[i] = jittered(cell % n, n, jitter(i));
    out[i + 1] = jittered(cell / n, n, jitter(i + 1));
  }
  for (uint32_t i = 4; i < kBlockSize; ++i)
    out[i] = jittered(permutation_element(member, cells, mix_bits(seed + i + 1)), cells, jitter(i));
}

}  // namespace etendue
