#include "sampling/halton.h"

#include <utility>

#include "sampling/owen.h"
#include "sampling/point_group.h"

namespace etendue {
namespace {

constexpr std::array<uint32_t, HaltonSampler::kDimensions> kPrimes{
    2,   3,   5,   7,   11,  13,  17,  19,  23,  29,  31,  37,  41,  43,  47,  53,  59,  61,  67,  71,  73,  79,
    83,  89,  97,  101, 103, 107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193,
    197, 199, 211, 223, 227, 229, 233, 239, 241, 251, 257, 263, 269, 271, 277, 281, 283, 293, 307, 311};

struct Resolution {
  int digits;
  uint64_t cells;
};

// The number of digits in this base that a float resolves (at least 2^24 cells).
constexpr Resolution resolution(uint32_t base) {
  Resolution r{0, 1};
  for (; r.cells < uint64_t{1} << 24; ++r.digits) r.cells *= base;
  return r;
}

// The scrambled radical inverse. The zeros after the last digit are scrambled as well. The base is a template parameter
// so that the compiler replaces divisions by multiplications.
template <uint32_t kBase>
float scrambled_inverse(uint32_t sample, uint32_t seed) {
  constexpr Resolution kResolution = resolution(kBase);
  uint64_t prefix = seed, reversed = 0;
  for (int k = 0; k < kResolution.digits; ++k) {
    const uint64_t bits = mix_bits(prefix + 0x9e3779b97f4a7c15ULL);
    const auto factor = 1 + static_cast<uint32_t>((bits >> 32) * (kBase - 1) >> 32);
    const auto shift = static_cast<uint32_t>((bits & 0xffffffffU) * kBase >> 32);
    const uint32_t digit = sample % kBase;
    sample /= kBase;
    reversed = reversed * kBase + (factor * digit + shift) % kBase;
    prefix = bits + digit;
  }
  const double x = static_cast<double>(reversed) * (1.0 / static_cast<double>(kResolution.cells));
  return std::min(static_cast<float>(x), kOneMinusEpsilon);
}

// In base 2 the radical inverse is the index with its bits reversed, which is the argument that the scrambling takes.
template <>
float scrambled_inverse<2>(uint32_t sample, uint32_t seed) {
  return to_unit_float(reverse_bits(owen_scramble_reversed(sample, seed)));
}

// Computes one block.
using Fill = void (*)(uint32_t sample, uint32_t seed, SampleBlock& out);

template <size_t kFirst, size_t... kIndex>
constexpr Fill fill_from(std::index_sequence<kIndex...>) {
  return [](uint32_t sample, uint32_t seed, SampleBlock& out) {
    ((out[kIndex] = scrambled_inverse<kPrimes[kFirst + kIndex]>(sample, hash_combine(seed, kIndex + 1))), ...);
  };
}

constexpr uint32_t kBlocks = HaltonSampler::kDimensions / kBlockSize;

template <size_t... kBlock>
constexpr std::array<Fill, kBlocks> fills(std::index_sequence<kBlock...>) {
  return {fill_from<kBlock * kBlockSize>(std::make_index_sequence<kBlockSize>())...};
}

constexpr std::array<Fill, kBlocks> kFills = fills(std::make_index_sequence<kBlocks>());

// The digits of `sample` in this base, each replaced by changed(digit), mirrored at the radix point. Integers and a
// single division, so that the result is the nearest double.
template <class Changed>
double inverse_of(uint32_t sample, uint32_t base, Changed&& changed) {
  uint64_t reversed = 0, cells = 1;
  while (sample > 0) {
    reversed = reversed * base + changed(sample % base);
    sample /= base;
    cells *= base;
  }
  return static_cast<double>(reversed) / static_cast<double>(cells);
}

}  // namespace

double HaltonSampler::radical_inverse(uint32_t sample, uint32_t base) {
  return inverse_of(sample, base, [](uint32_t digit) { return digit; });
}

double HaltonSampler::radical_inverse(uint32_t sample, std::span<const uint16_t> permutation) {
  return inverse_of(sample, static_cast<uint32_t>(permutation.size()),
                    [&](uint32_t digit) { return permutation[digit]; });
}

std::vector<uint16_t> HaltonSampler::faure_permutation(uint32_t base) {
  if (base == 2) return {0, 1};
  std::vector<uint16_t> result;
  if (base % 2 == 0) {
    const auto half = faure_permutation(base / 2);
    for (const uint16_t add : {0, 1})
      for (const uint16_t value : half) result.push_back(static_cast<uint16_t>(2 * value + add));
    return result;
  }
  const auto middle = static_cast<uint16_t>((base - 1) / 2);
  for (const uint16_t value : faure_permutation(base - 1))
    result.push_back(value < middle ? value : static_cast<uint16_t>(value + 1));
  result.insert(result.begin() + middle, middle);
  return result;
}

float HaltonSampler::rotated_inverse(uint32_t sample, uint32_t dimension, uint32_t seed) const {
  if (scrambling.value == HaltonScrambling::rotation) return rotated(radical_inverse(sample, kPrimes[dimension]), seed);
  static const auto permutations = [] {
    std::array<std::vector<uint16_t>, kDimensions> all;
    std::ranges::transform(kPrimes, all.begin(), faure_permutation);
    return all;
  }();
  return rotated(radical_inverse(sample, permutations[dimension]), seed);
}

void HaltonSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const uint32_t seed = hash_combine(pixel_seed, block);
  // After the last dimension the order of samples is shuffled by a nested permutation, which maps aligned groups of 2^k
  // samples to such groups.
  const bool is_padding = block >= kBlocks;
  const uint32_t index = is_padding ? owen_scramble(sample, mix_bits(seed)) : sample, used = is_padding ? 0 : block;
  if (scrambling.value == HaltonScrambling::owen) return kFills[used](index, seed, out);
  for (uint32_t k = 0; k < kBlockSize; ++k)
    out[k] = rotated_inverse(index, used * kBlockSize + k, hash_combine(seed, k + 1));
}

}  // namespace etendue
