// Weights of multiple importance sampling.                                        thesis 6.6.9; Veach 1997, 9.2
#pragma once
#include <array>

#include "base/parameter.h"
#include "base/vec.h"

namespace etendue::transport {

enum class MisHeuristic { balance, power, maximum };

// Densities beyond this count as this: the squares of larger ones are no floats.
inline constexpr float kLargestDensity = 1e19f;

// The weight of the technique with density `own` where the other one has density `other`, both of the same measure,
// over `own`: what an estimate is multiplied with.
inline float mis_weight_over_pdf(MisHeuristic heuristic, float own, float other) {
  switch (heuristic) {
    case MisHeuristic::balance:
      return 1 / (own + other);
    case MisHeuristic::maximum:
      return (own > other ? 1.0f : own == other ? 0.5f : 0.0f) / own;
    case MisHeuristic::power:
      break;
  }
  own = std::min(own, kLargestDensity);
  other = std::min(other, kLargestDensity);
  return own / (own * own + other * other);
}

inline float mis_weight(MisHeuristic heuristic, float own, float other) {
  return std::min(own, kLargestDensity) * mis_weight_over_pdf(heuristic, own, other);
}

}  // namespace etendue::transport

template <>
struct etendue::Options<etendue::transport::MisHeuristic> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"balance", "Balance"}, {"power", "Power (beta = 2)"}, {"maximum", "Maximum"}}};
};
