// A sequence of independent uniform numbers in double precision.
#pragma once
#include <cstdint>

#include "base/hash.h"

namespace etendue::equations {

// Number k is a hash of the seed and k, so that different seeds give independent sequences.
class RandomNumbers {
 public:
  explicit RandomNumbers(uint64_t seed) : key_(mix_bits(seed + uint64_t{0x9e3779b97f4a7c15})) {}

  // In [0, 1), a multiple of 2^-53.
  double uniform() {
    return static_cast<double>(mix_bits(key_ + ++count_ * uint64_t{0xd1342543de82ef95}) >> 11) * 0x1p-53;
  }

 private:
  uint64_t key_, count_ = 0;
};

}  // namespace etendue::equations
