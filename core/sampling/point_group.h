// Fixed-size point sets as samplers
//
// Samples are drawn in groups of the size of the set. In a group, each two-dimensional decision (dimensions 0-1 and 2-3
// of a block) takes the points of the set in a random order, and each one-dimensional decision has one point in each of
// as many intervals. Orders and randomisations are independent for each group, pixel, block and decision. Complete
// groups have the properties of the set; beyond one group the convergence rate is that of random numbers.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/hash.h"
#include "sampling/permutation.h"
#include "sampling/sampler.h"

namespace etendue {

struct GroupMember {
  uint32_t seed;   // of the group in a pixel and block
  uint32_t index;  // of the sample in its group
};
inline GroupMember group_member(uint32_t pixel_seed, uint32_t sample, uint32_t block, uint32_t group_size) {
  return {hash_combine(hash_combine(pixel_seed, block), sample / group_size), sample % group_size};
}

// A point of interval `cell` of `cells` in [0, 1). The limit prevents that rounding moves it into the next interval.
inline float jittered(uint32_t cell, uint32_t cells, float jitter) {
  const auto start = static_cast<float>(cell), count = static_cast<float>(cells);
  const float below_end = std::bit_cast<float>(std::bit_cast<uint32_t>((start + 1) / count) - 1);
  return std::min((start + jitter) / count, below_end);
}
// Dimension k of a group of jittered intervals in random order.
inline float jittered_interval(const GroupMember& member, uint32_t k, uint32_t cells) {
  const float jitter = to_unit_float(hash_combine(member.seed, member.index * kBlockSize + k));
  return jittered(permutation_element(member.index, cells, mix_bits(member.seed + k + 1)), cells, jitter);
}

// x plus a random offset, modulo 1.                                                   [Cranley and Patterson 1976]
inline float rotated(double x, uint32_t seed) {
  const double sum = x + static_cast<double>(mix_bits(seed)) * 0x1p-32;
  return std::min(static_cast<float>(sum - std::floor(sum)), kOneMinusEpsilon);
}

// The block of a sample. point(i, seed) is point i of the set, an array of two numbers in [0, 1), in a randomisation
// that the seed selects.
template <class Point>
void fill_from_group(const GroupMember& member, uint32_t group_size, SampleBlock& out, Point&& point) {
  for (uint32_t k = 0; k < 4; k += 2) {
    const uint32_t seed = mix_bits(member.seed + k + 1);
    const auto p = point(permutation_element(member.index, group_size, seed), hash_combine(seed, k));
    out[k] = p[0];
    out[k + 1] = p[1];
  }
  for (uint32_t k = 4; k < kBlockSize; ++k) out[k] = jittered_interval(member, k, group_size);
}

}  // namespace etendue
