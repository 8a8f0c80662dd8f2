#include "sampling/blue_noise.h"

#include <algorithm>
#include <bit>

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

// The position of a sample in the orders of pixels. Of the samples from 2^h to 2^(h + 1) - 1, each pixel has an order of its
// own, a nested permutation, so that the first 2^m samples are the same in all pixels for each m.
struct OrderedSample {
  uint32_t group, reversed, mask;  // 2^h; the place in the group, with its h digits reversed; 2^h - 1
  int shift;                       // 32 - h

  explicit OrderedSample(uint32_t sample) {
    const int h = std::max(0, static_cast<int>(std::bit_width(sample)) - 1);
    group = sample == 0 ? 0 : 1U << h;
    mask = (1U << h) - 1;
    shift = h == 0 ? 0 : 32 - h;
    reversed = h == 0 ? 0 : reverse_bits(sample ^ group) >> shift;
  }
};

// The seeds of a pixel in a block of dimensions.
struct PixelSeed {
  uint32_t tile, pixel, reversed_place;
};
[[gnu::always_inline]] inline PixelSeed pixel_seed_of(uint32_t seed, uint32_t block) {
  return {hash_combine(seed & kTileMask, block), hash_combine(seed, block), seed >> kPlaceShift};
}

// The sample of decision k, and the position of the pixel in the order of the tile.
struct Position {
  uint32_t sample, pixel;
};
[[gnu::always_inline]] inline Position position(const OrderedSample& sample, const PixelSeed& seed, uint32_t k) {
  const uint32_t order = decision_seed(seed.pixel, 2 * k + 1 + sample.group);
  const uint32_t in_group = owen_scramble_reversed(sample.reversed, order) & sample.mask;
  const uint32_t place = owen_scramble_reversed(seed.reversed_place, decision_seed(seed.tile, 2 * k + 1)) & kPlaceMask;
  return {sample.group | reverse_bits(in_group) >> sample.shift, reverse_bits(place) >> kPlaceShift};
}

[[gnu::always_inline]] inline float first_coordinate(const Position& p, uint32_t seed, uint32_t k) {
  return scrambled_coordinate(p.sample ^ transposed_pascal(p.pixel), decision_seed(seed, 2 * k));
}
[[gnu::always_inline]] inline float second_coordinate(const Position& p, uint32_t seed, uint32_t k) {
  const uint32_t shift = transposed_pascal(reversed_second_coordinate(p.pixel));
  return scrambled_coordinate(reversed_second_coordinate(p.sample) ^ shift, decision_seed(seed, 2 * k + 2));
}

constexpr uint32_t kPairDimensions = 4;  // the dimensions that are decisions in pairs

ETENDUE_VECTORIZE void fill_table(uint32_t sample_index, const uint32_t* pixel_seeds, size_t count, uint32_t block,
                                  DimensionSet requested, SampleTable& out) {
  const OrderedSample sample(sample_index);
  std::array<uint32_t, SampleTable::kPaths> tiles{}, pixels{}, places{};
  for (size_t i = 0; i < count; ++i) {
    const PixelSeed seed = pixel_seed_of(pixel_seeds[i], block);
    tiles[i] = seed.tile;
    pixels[i] = seed.pixel;
    places[i] = seed.reversed_place;
  }
  for (uint32_t k = 0; k < kPairDimensions; k += 2) {
    if ((requested >> k & 3U) == 0) continue;
    float* x = out.values[k].data();
    float* y = out.values[k + 1].data();
    for (size_t i = 0; i < padded_lanes(count); ++i) {
      const Position p = position(sample, {tiles[i], pixels[i], places[i]}, k);
      x[i] = first_coordinate(p, tiles[i], k);
      y[i] = second_coordinate(p, tiles[i], k);
    }
  }
  for (uint32_t k = kPairDimensions; k < kBlockSize; ++k) {
    if ((requested >> k & 1U) == 0) continue;
    float* values = out.values[k].data();
    for (size_t i = 0; i < padded_lanes(count); ++i)
      values[i] = first_coordinate(position(sample, {tiles[i], pixels[i], places[i]}, k), tiles[i], k);
  }
}

}  // namespace

void BlueNoiseSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const PixelSeed seed = pixel_seed_of(pixel_seed, block);
  const OrderedSample ordered(sample);
  for (uint32_t k = 0; k < kPairDimensions; k += 2) {
    const Position p = position(ordered, seed, k);
    out[k] = first_coordinate(p, seed.tile, k);
    out[k + 1] = second_coordinate(p, seed.tile, k);
  }
  for (uint32_t k = kPairDimensions; k < kBlockSize; ++k)
    out[k] = first_coordinate(position(ordered, seed, k), seed.tile, k);
}

DimensionSet BlueNoiseSampler::blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block,
                                      DimensionSet requested, SampleTable& out) const {
  fill_table(sample, pixel_seeds.data(), pixel_seeds.size(), block, requested, out);
  return requested | (requested & 3U ? 3U : 0U) | (requested & 12U ? 12U : 0U);
}

}  // namespace etendue
