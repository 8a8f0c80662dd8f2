#include "sampling/halton.h"

#include "sampling/owen.h"
#include "sampling/permutation.h"

namespace etendue {
namespace {

constexpr std::array<uint32_t, HaltonSampler::kDimensions> kPrimes{
    2,   3,   5,   7,   11,  13,  17,  19,  23,  29,  31,  37,  41,  43,  47,  53,  59,  61,  67,  71,  73,  79,
    83,  89,  97,  101, 103, 107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193,
    197, 199, 211, 223, 227, 229, 233, 239, 241, 251, 257, 263, 269, 271, 277, 281, 283, 293, 307, 311};

// Digits are scrambled until they are finer than a float can tell: the digits of zero behind the last one too.
float scrambled_inverse(uint32_t sample, uint32_t base, uint32_t seed) {
  const double inverse_base = 1.0 / base;
  double weight = inverse_base, x = 0;
  uint32_t prefix = seed;
  while (weight > 0x1p-26) {
    const uint32_t digit = sample % base;
    sample /= base;
    x += weight * permuted(digit, base, mix_bits(prefix));
    prefix = hash_combine(prefix, digit + 1);
    weight *= inverse_base;
  }
  return std::min(static_cast<float>(x), kOneMinusEpsilon);
}

}  // namespace

double HaltonSampler::radical_inverse(uint32_t sample, uint32_t base) {
  double weight = 1.0 / base, x = 0;
  for (; sample > 0; sample /= base, weight /= base) x += weight * (sample % base);
  return x;
}

void HaltonSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const uint32_t seed = hash_combine(pixel_seed, block);
  uint32_t first = block * kBlockSize;
  if (first >= kDimensions) {
    // A shuffle that keeps powers of two together; the low bases see a random order of the same samples.
    sample = owen_scramble(sample, mix_bits(seed));
    first = 0;
  }
  for (uint32_t i = 0; i < kBlockSize; ++i) out[i] = scrambled_inverse(sample, kPrimes[first + i], hash_combine(seed, i + 1));
}

}  // namespace etendue
