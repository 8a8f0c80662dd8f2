// A random permutation of 0..n-1 that is computed, not stored.       A. Kensler, "Correlated Multi-Jittered Sampling", 2013
#pragma once
#include <bit>

#include "base/hash.h"

namespace etendue {

// The image of i (below n) under the permutation that `seed` names: a hash on the next power of two, walked until it falls
// below n.
constexpr uint32_t permuted(uint32_t i, uint32_t n, uint32_t seed) {
  const uint32_t mask = std::bit_ceil(n) - 1;
  do {
    i ^= seed;
    i *= 0xe170893dU;
    i ^= seed >> 16;
    i ^= (i & mask) >> 4;
    i ^= seed >> 8;
    i *= 0x0929eb3fU;
    i ^= seed >> 23;
    i ^= (i & mask) >> 1;
    i *= 1 | seed >> 27;
    i *= 0x6935fa69U;
    i ^= (i & mask) >> 11;
    i *= 0x74dcb303U;
    i ^= (i & mask) >> 2;
    i *= 0x9e501cc3U;
    i ^= (i & mask) >> 2;
    i *= 0xc860a3dfU;
    i &= mask;
    i ^= i >> 5;
  } while (i >= n);
  return (i + seed) % n;
}

}  // namespace etendue
