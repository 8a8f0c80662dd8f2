// Weights of multiple importance sampling.              [Lang, sec. 6.6.9; Veach and Guibas 1995; Veach 1997, sec. 9.2]
#pragma once
#include <array>

#include "base/parameter.h"
#include "base/vec.h"

namespace etendue::transport {

enum class MisHeuristic { balance, power, maximum };

// Densities are clamped to this value; the squares of larger ones overflow.
inline constexpr float kLargestDensity = 1e19f;

// The weight of the technique with density `pdf`, divided by `pdf`, where one other technique has density `other_pdf`
// of the same measure: the factor of an estimate.
inline float mis_weight_over_pdf(MisHeuristic heuristic, float pdf, float other_pdf) {
  switch (heuristic) {
    case MisHeuristic::balance:
      return 1 / (pdf + other_pdf);
    case MisHeuristic::maximum:
      return (pdf > other_pdf ? 1.0f : pdf == other_pdf ? 0.5f : 0.0f) / pdf;
    case MisHeuristic::power:
      break;
  }
  pdf = std::min(pdf, kLargestDensity);
  other_pdf = std::min(other_pdf, kLargestDensity);
  return pdf / (pdf * pdf + other_pdf * other_pdf);
}

inline float mis_weight(MisHeuristic heuristic, float pdf, float other_pdf) {
  return std::min(pdf, kLargestDensity) * mis_weight_over_pdf(heuristic, pdf, other_pdf);
}

}  // namespace etendue::transport

template <>
struct etendue::Options<etendue::transport::MisHeuristic> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"balance", "Balance"}, {"power", "Power (beta = 2)"}, {"maximum", "Maximum"}}};
};
