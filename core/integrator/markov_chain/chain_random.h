// Random numbers of a Markov chain: as many as it asks for, one after the other.         splitmix64; Steele et al. 2014
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

// Distances and angles of perturbations: from `least` to `most` and as often in each octave; u = 0 is the largest.
//                                                                                                      thesis (9.123)
struct Octaves {
  float least, most;
  float at(float u) const { return most * std::exp(-std::log(most / least) * u); }
};

}  // namespace etendue::integrator
