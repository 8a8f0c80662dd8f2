// The random number generator of a Markov chain: splitmix64 [Steele et al. 2014].
#pragma once
#include "base/hash.h"
#include "base/vec.h"

namespace etendue::integrator {

class ChainRandom {
 public:
  ChainRandom() = default;
  explicit ChainRandom(uint64_t seed) : state_(mix_bits(seed)) {}

  uint32_t bits() { return static_cast<uint32_t>(mix_bits(state_ += uint64_t{0x9e3779b97f4a7c15}) >> 32); }
  float next() { return to_unit_float(bits()); }
  Vec2 next_2d() {
    const float x = next();
    return {x, next()};
  }

 private:
  uint64_t state_ = 0;
};

// A distribution with density proportional to 1 / x on [min, max], for distances and angles of perturbations; u = 0
// gives the maximum. [Lang, eq. 9.123]
struct LogUniform {
  float min, max;
  float sample(float u) const { return max * std::exp(-std::log(max / min) * u); }
};

}  // namespace etendue::integrator
