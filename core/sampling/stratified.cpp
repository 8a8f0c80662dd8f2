#include "sampling/stratified.h"

#include "sampling/permutation.h"

namespace etendue {

void StratifiedSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const auto n = static_cast<uint32_t>(side.value);
  const uint32_t group = sample / (n * n), member = sample % (n * n);
  const uint32_t seed = hash_combine(hash_combine(pixel_seed, block), group);
  const auto jitter = [&](uint32_t i) { return to_unit_float(mix_bits(hash_combine(seed, member * kBlockSize + i))); };
  const auto put = [&](size_t i, float cell, uint32_t cells) {
    out[i] = std::min((cell + jitter(static_cast<uint32_t>(i))) / static_cast<float>(cells), kOneMinusEpsilon);
  };
  // Dimensions 0-1 and 2-3 of every block belong together.
  for (uint32_t pair = 0; pair < 2; ++pair) {
    const uint32_t cell = permuted(member, n * n, mix_bits(seed + pair + 1));
    put(2 * pair, static_cast<float>(cell % n), n);
    put(2 * pair + 1, static_cast<float>(cell / n), n);
  }
  for (uint32_t i = 4; i < kBlockSize; ++i) put(i, static_cast<float>(permuted(member, n * n, mix_bits(seed + 16 + i))), n * n);
}

}  // namespace etendue
