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

// The MIS weight of a connection through scattering media. All other techniques sample its segment by a free flight, so
// their densities contain the probability `survival` that the flight passes it, which is known after tracing.
struct ConnectionWeight {
  float factor = 0;  // of the weight
  float others = 0;  // the sum of powers, or the maximum, of the ratios of densities if `survival` is 1
  MisHeuristic heuristic = MisHeuristic::power;

  // Without the factor. `others` may be infinite.
  float at(float survival) const {
    if (!(survival > 0)) return 0;
    const float sum = others * survival;
    if (heuristic == MisHeuristic::maximum) return sum < 1 ? 1.0f : 0.0f;
    return 1 / (1 + (heuristic == MisHeuristic::power ? sum * survival : sum));
  }
  friend ConnectionWeight operator/(ConnectionWeight w, float by) {
    w.factor /= by;
    return w;
  }
};

// The factor that is known before a connection is traced; other techniques have weights that do not depend on it.
inline float known_factor(float weight) { return weight; }
inline float known_factor(const ConnectionWeight& weight) { return weight.factor; }

}  // namespace etendue::transport

template <>
struct etendue::Options<etendue::transport::MisHeuristic> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"balance", "Balance"}, {"power", "Power, exponent 2"}, {"maximum", "Maximum"}}};
};
