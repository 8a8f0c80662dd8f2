// Integer hash functions.
//
// All random numbers are hashes of a key (seed, pixel, sample index, dimension). A random number therefore does not
// depend on the order in which threads request it.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

namespace etendue {

// Bijection with good avalanche behaviour [Wellons 2018, lowbias32].
constexpr uint32_t mix_bits(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

// Finaliser of SplitMix64 [Steele et al. 2014], with the constants of variant 13 of [Stafford 2011].
constexpr uint64_t mix_bits(uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebULL;
  x ^= x >> 31;
  return x;
}

// For literals with the suffix ULL, which would be ambiguous where uint64_t is `unsigned long`.
constexpr uint64_t mix_bits(unsigned long long x) { return mix_bits(static_cast<uint64_t>(x)); }

// A hash of `value` under a seed.
constexpr uint32_t hash_combine(uint32_t seed, uint32_t value) {
  return mix_bits(seed ^ (value + 0x9e3779b9U + (seed << 6) + (seed >> 2)));
}

// A hash of a byte string.
constexpr uint64_t hash_bytes(const char* data, std::size_t size, uint64_t seed = 0x243f6a8885a308d3ULL) {
  uint64_t h = seed ^ (size * 0x9e3779b97f4a7c15ULL);
  for (std::size_t i = 0; i < size; ++i) {
    const uint64_t byte = static_cast<unsigned char>(data[i]);
    h = mix_bits(h ^ (byte + uint64_t{0x9e3779b97f4a7c15}));
  }
  return h;
}

// A uniform number in [0, 1) from the upper 24 bits. All multiples of 2^-24 are equally likely.
constexpr float to_unit_float(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

// The bits in reverse order: bit i becomes bit 31 - i.
constexpr uint32_t reverse_bits(uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0xff00ff00U) >> 8) | ((x & 0x00ff00ffU) << 8);
  x = ((x & 0xf0f0f0f0U) >> 4) | ((x & 0x0f0f0f0fU) << 4);
  x = ((x & 0xccccccccU) >> 2) | ((x & 0x33333333U) << 2);
  x = ((x & 0xaaaaaaaaU) >> 1) | ((x & 0x55555555U) << 1);
  return x;
}

}  // namespace etendue
