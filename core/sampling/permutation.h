// A pseudo-random permutation of 0, ..., n - 1 without a table                                     [Kensler 2013]
//
// Rounds of steps that are invertible modulo a power of two: adding a key, multiplying by an odd number, and xor of the
// upper half of the bits onto the lower half. They are repeated until the result is below n (cycle walking). Over
// random seeds, each element is uniform. Pairs of elements deviate from the uniform distribution by less than 10 % root
// mean square, which is sufficient for variances. (The rounds of [Kensler 2013] reach only 8 of the 24 permutations of
// four elements.)
#pragma once
#include <bit>

#include "base/hash.h"

namespace etendue {

// Element i of the permutation with this seed. Requires i < n <= 2^31 and a hashed seed.
constexpr uint32_t permutation_element(uint32_t i, uint32_t n, uint32_t seed) {
  constexpr int kRounds = 6;
  const int bits = std::bit_width(n - 1), half = (bits + 1) / 2;
  const uint32_t mask = (uint32_t{1} << bits) - 1;
  do {
    uint32_t key = seed;
    for (int round = 0; round < kRounds; ++round) {
      i = (i + (key >> 8)) * (key >> 16 | 1U) & mask;
      i ^= i >> half;
      key = key * 747796405U + 2891336453U;
    }
  } while (i >= n);
  // A rotation by an independent hash makes each element uniform.
  const uint32_t rotated = i + static_cast<uint32_t>(uint64_t{mix_bits(seed)} * n >> 32);
  return rotated < n ? rotated : rotated - n;
}

}  // namespace etendue
