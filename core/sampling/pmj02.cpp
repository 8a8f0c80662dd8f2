#include "sampling/pmj02.h"

#include "base/vectorize.h"
#include "sampling/owen.h"

namespace etendue {
namespace {

// The second coordinate of the Sobol' sequence with reversed bits: bit i is the sum over the bits j of the index for which
// binomial(j, i) is odd, that is, for which the binary digits of j include those of i. A sum over supersets takes one step
// for each digit of the positions [Ahmed 2024].
[[gnu::always_inline]] inline uint32_t reversed_second_coordinate(uint32_t index) {
  index ^= index >> 16 & 0x0000ffffU;
  index ^= index >> 8 & 0x00ff00ffU;
  index ^= index >> 4 & 0x0f0f0f0fU;
  index ^= index >> 2 & 0x33333333U;
  index ^= index >> 1 & 0x55555555U;
  return index;
}

[[gnu::always_inline]] inline float scrambled(uint32_t reversed, uint32_t seed) {
  const uint32_t x = reverse_bits(owen_scramble_reversed(reversed, seed));
  return static_cast<float>(static_cast<int32_t>(x >> 8)) * 0x1p-24f;
}

// The seed of a dimension in a block. The seeds of the orders of samples have odd multiples, those of coordinates even.
[[gnu::always_inline]] inline uint32_t dimension_seed(uint32_t block_seed, uint32_t k) {
  return mix_bits(block_seed + k * 0x9e3779b9U);
}

// The position of a sample in the order of decision k. A nested permutation maps aligned groups of 2^m samples to such
// groups.
[[gnu::always_inline]] inline uint32_t shuffled(uint32_t reversed_sample, uint32_t block_seed, uint32_t k) {
  return reverse_bits(owen_scramble_reversed(reversed_sample, dimension_seed(block_seed, 2 * k + 1)));
}

// Dimensions k and k + 1.
struct Pair {
  float x, y;
};
[[gnu::always_inline]] inline Pair pair(uint32_t reversed_sample, uint32_t block_seed, uint32_t k) {
  const uint32_t index = shuffled(reversed_sample, block_seed, k);
  return {scrambled(index, dimension_seed(block_seed, 2 * k)),
          scrambled(reversed_second_coordinate(index), dimension_seed(block_seed, 2 * k + 2))};
}

// The first coordinate of the sequence is the index with reversed bits, which is the argument of the scrambling.
[[gnu::always_inline]] inline float single(uint32_t reversed_sample, uint32_t block_seed, uint32_t k) {
  return scrambled(shuffled(reversed_sample, block_seed, k), dimension_seed(block_seed, 2 * k));
}

constexpr uint32_t kPairs = 4;  // the dimensions that are decisions in pairs

ETENDUE_VECTORIZE void fill(uint32_t reversed_sample, const uint32_t* pixel_seeds, size_t count, uint32_t block,
                            DimensionSet requested, SampleTable& out) {
  std::array<uint32_t, SampleTable::kPaths> seeds{};
  for (size_t i = 0; i < count; ++i) seeds[i] = hash_combine(pixel_seeds[i], block);
  for (uint32_t k = 0; k < kPairs; k += 2) {
    if ((requested >> k & 3U) == 0) continue;
    float* x = out.values[k].data();
    float* y = out.values[k + 1].data();
    for (size_t i = 0; i < padded_lanes(count); ++i) {
      const Pair p = pair(reversed_sample, seeds[i], k);
      x[i] = p.x;
      y[i] = p.y;
    }
  }
  for (uint32_t k = kPairs; k < kBlockSize; ++k) {
    if ((requested >> k & 1U) == 0) continue;
    float* values = out.values[k].data();
    for (size_t i = 0; i < padded_lanes(count); ++i) values[i] = single(reversed_sample, seeds[i], k);
  }
}

}  // namespace

void Pmj02Sampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const uint32_t seed = hash_combine(pixel_seed, block), reversed = reverse_bits(sample);
  for (uint32_t k = 0; k < kPairs; k += 2) {
    const Pair p = pair(reversed, seed, k);
    out[k] = p.x;
    out[k + 1] = p.y;
  }
  for (uint32_t k = kPairs; k < kBlockSize; ++k) out[k] = single(reversed, seed, k);
}

DimensionSet Pmj02Sampler::blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block,
                                  DimensionSet requested, SampleTable& out) const {
  fill(reverse_bits(sample), pixel_seeds.data(), pixel_seeds.size(), block, requested, out);
  return requested | (requested & 3U ? 3U : 0U) | (requested & 12U ? 12U : 0U);
}

}  // namespace etendue
