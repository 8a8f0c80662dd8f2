#include "sampling/pmj02.h"

#include "base/vectorize.h"
#include "sampling/zero_two_sequence.h"

namespace etendue {
namespace {

// Dimensions k and k + 1.
struct Pair {
  float x, y;
};
[[gnu::always_inline]] inline Pair pair(uint32_t reversed_sample, uint32_t block_seed, uint32_t k) {
  const uint32_t index = ordered_sample(reversed_sample, block_seed, k);
  return {scrambled_coordinate(index, decision_seed(block_seed, 2 * k)),
          scrambled_coordinate(reversed_second_coordinate(index), decision_seed(block_seed, 2 * k + 2))};
}

// The first coordinate of the sequence is the index with reversed bits, which is the argument of the scrambling.
[[gnu::always_inline]] inline float single(uint32_t reversed_sample, uint32_t block_seed, uint32_t k) {
  return scrambled_coordinate(ordered_sample(reversed_sample, block_seed, k), decision_seed(block_seed, 2 * k));
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
