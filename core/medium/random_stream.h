// An unbounded sequence of uniform numbers, a function of its seed.
#pragma once
#include "base/hash.h"
#include "base/vec.h"

namespace etendue {

class RandomStream {
 public:
  explicit RandomStream(uint32_t seed) : state_(mix_bits(uint64_t{seed} + kIncrement)) {}

  // Uniform in [0, 1).                                                                        [Steele et al. 2014]
  float next() {
    state_ += kIncrement;
    return to_unit_float(static_cast<uint32_t>(mix_bits(state_) >> 32));
  }
  // Exponentially distributed with a mean of 1.
  float next_exponential() { return -std::log1p(-next()); }

 private:
  static constexpr uint64_t kIncrement = 0x9e3779b97f4a7c15ULL;
  uint64_t state_;
};

}  // namespace etendue
