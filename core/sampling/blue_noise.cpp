#include "sampling/blue_noise.h"

#include "base/vectorize.h"
#include "sampling/zero_two_sequence.h"

namespace etendue {
namespace {

constexpr int kPlaceBits = 2 * BlueNoiseSampler::kTileBits, kPlaceShift = 32 - kPlaceBits;
constexpr uint32_t kPlaceMask = (1U << kPlaceBits) - 1, kTileMask = (1U << kPlaceShift) - 1;

// The transposed Pascal matrix times a vector, whose digit c is bit c: bit r is the sum over the bits c for which
// binomial(r, c) is odd, that is, for which the binary digits of r include those of c.
[[gnu::always_inline]] inline uint32_t transposed_pascal(uint32_t x) {
  x ^= x << 16 & 0xffff0000U;
  x ^= x << 8 & 0xff00ff00U;
  x ^= x << 4 & 0xf0f0f0f0U;
  x ^= x << 2 & 0xccccccccU;
  x ^= x << 1 & 0xaaaaaaaaU;
  return x;
}

// The samples of a decision: those of a pixel follow each other in an order of the tile, and so do the pixels.
struct Position {
  uint32_t sample, pixel;
};
[[gnu::always_inline]] inline Position position(uint32_t reversed_sample, uint32_t reversed_place, uint32_t seed,
                                                uint32_t k) {
  constexpr uint32_t kPixelOrders = 2 * kBlockSize;
  const uint32_t place =
      owen_scramble_reversed(reversed_place, decision_seed(seed, kPixelOrders + 2 * k + 1)) & kPlaceMask;
  return {ordered_sample(reversed_sample, seed, k), reverse_bits(place) >> kPlaceShift};
}

[[gnu::always_inline]] inline float first_coordinate(const Position& p, uint32_t seed, uint32_t k) {
  return scrambled_coordinate(p.sample ^ transposed_pascal(p.pixel), decision_seed(seed, 2 * k));
}
[[gnu::always_inline]] inline float second_coordinate(const Position& p, uint32_t seed, uint32_t k) {
  const uint32_t shift = transposed_pascal(reversed_second_coordinate(p.pixel));
  return scrambled_coordinate(reversed_second_coordinate(p.sample) ^ shift, decision_seed(seed, 2 * k + 2));
}

constexpr uint32_t kPairDimensions = 4;  // the dimensions that are decisions in pairs

ETENDUE_VECTORIZE void fill_table(uint32_t reversed_sample, const uint32_t* pixel_seeds, size_t count, uint32_t block,
                            DimensionSet requested, SampleTable& out) {
  std::array<uint32_t, SampleTable::kPaths> seeds{}, places{};
  for (size_t i = 0; i < count; ++i) {
    seeds[i] = hash_combine(pixel_seeds[i] & kTileMask, block);
    places[i] = pixel_seeds[i] >> kPlaceShift;
  }
  for (uint32_t k = 0; k < kPairDimensions; k += 2) {
    if ((requested >> k & 3U) == 0) continue;
    float* x = out.values[k].data();
    float* y = out.values[k + 1].data();
    for (size_t i = 0; i < padded_lanes(count); ++i) {
      const Position p = position(reversed_sample, places[i], seeds[i], k);
      x[i] = first_coordinate(p, seeds[i], k);
      y[i] = second_coordinate(p, seeds[i], k);
    }
  }
  for (uint32_t k = kPairDimensions; k < kBlockSize; ++k) {
    if ((requested >> k & 1U) == 0) continue;
    float* values = out.values[k].data();
    for (size_t i = 0; i < padded_lanes(count); ++i)
      values[i] = first_coordinate(position(reversed_sample, places[i], seeds[i], k), seeds[i], k);
  }
}

}  // namespace

void BlueNoiseSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const uint32_t seed = hash_combine(pixel_seed & kTileMask, block), place = pixel_seed >> kPlaceShift;
  const uint32_t reversed = reverse_bits(sample);
  for (uint32_t k = 0; k < kPairDimensions; k += 2) {
    const Position p = position(reversed, place, seed, k);
    out[k] = first_coordinate(p, seed, k);
    out[k + 1] = second_coordinate(p, seed, k);
  }
  for (uint32_t k = kPairDimensions; k < kBlockSize; ++k) out[k] = first_coordinate(position(reversed, place, seed, k), seed, k);
}

DimensionSet BlueNoiseSampler::blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block,
                                      DimensionSet requested, SampleTable& out) const {
  fill_table(reverse_bits(sample), pixel_seeds.data(), pixel_seeds.size(), block, requested, out);
  return requested | (requested & 3U ? 3U : 0U) | (requested & 12U ? 12U : 0U);
}

}  // namespace etendue
