// The (0,2) sequence of the first two dimensions of Sobol', in an order of its own for each decision of a path
//                                                                        [Helmer et al. 2021; Ahmed 2024; Owen 1995]
#pragma once
#include "sampling/owen.h"

namespace etendue {

// The second coordinate of the Sobol' sequence with reversed bits: bit i is the sum over the bits j of the index for which
// binomial(j, i) is odd, that is, for which the binary digits of j include those of i. A sum over supersets takes one step
// for each digit of the positions [Ahmed 2024]. The first coordinate with reversed bits is the index.
[[gnu::always_inline]] inline uint32_t reversed_second_coordinate(uint32_t index) {
  index ^= index >> 16 & 0x0000ffffU;
  index ^= index >> 8 & 0x00ff00ffU;
  index ^= index >> 4 & 0x0f0f0f0fU;
  index ^= index >> 2 & 0x33333333U;
  index ^= index >> 1 & 0x55555555U;
  return index;
}

// A coordinate with reversed bits, after nested scrambling.
[[gnu::always_inline]] inline float scrambled_coordinate(uint32_t reversed, uint32_t seed) {
  const uint32_t x = reverse_bits(owen_scramble_reversed(reversed, seed));
  return static_cast<float>(static_cast<int32_t>(x >> 8)) * 0x1p-24f;
}

// Seeds of a block of dimensions. Those of the orders of samples have odd numbers, those of coordinates even ones.
[[gnu::always_inline]] inline uint32_t decision_seed(uint32_t block_seed, uint32_t number) {
  return mix_bits(block_seed + number * 0x9e3779b9U);
}

// The position of a sample in the order of decision k. A nested permutation maps aligned groups of 2^m samples to such
// groups.
[[gnu::always_inline]] inline uint32_t ordered_sample(uint32_t reversed_sample, uint32_t block_seed, uint32_t k) {
  return reverse_bits(owen_scramble_reversed(reversed_sample, decision_seed(block_seed, 2 * k + 1)));
}

}  // namespace etendue
