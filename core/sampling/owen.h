// Nested uniform (Owen) scrambling by hashing                  [Lang, sec. 7.3; Owen 1995; Laine and Karras 2011]
//
// An operation on the reversed bits in which each bit depends only on lower bits is a nested permutation of elementary
// intervals [Laine and Karras 2011]. The constants are those of [Vegdahl 2021].
#pragma once
#include "base/hash.h"

namespace etendue {

// Argument and result have their bits in reversed order.
constexpr uint32_t owen_scramble_reversed(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

constexpr uint32_t owen_scramble(uint32_t x, uint32_t seed) {
  return reverse_bits(owen_scramble_reversed(reverse_bits(x), seed));
}

}  // namespace etendue
