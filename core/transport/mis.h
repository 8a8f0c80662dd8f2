// Weights of multiple importance sampling.                                        thesis 6.6.9; Veach 1997, 9.2
#pragma once
#include <array>

#include "base/parameter.h"
#include "base/vec.h"

namespace etendue::transport {

enum class MisHeuristic { balance, power, maximum };

// The weight of the technique with density `own` where the other one has density `other`, both of the same measure.
inline float mis_weight(MisHeuristic heuristic, float own, float other) {
  switch (heuristic) {
    case MisHeuristic::balance:
      return own / (own + other);
    case MisHeuristic::maximum:
      return own > other ? 1.0f : own == other ? 0.5f : 0.0f;
    case MisHeuristic::power:
      break;
  }
  // Ratios first: squares of the densities of narrow lobes overflow.
  const float ratio = other / own;
  return 1 / (1 + ratio * ratio);
}

}  // namespace etendue::transport

template <>
struct etendue::Options<etendue::transport::MisHeuristic> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"balance", "Balance"}, {"power", "Power (beta = 2)"}, {"maximum", "Maximum"}}};
};
