// MIS weights of the two techniques that find direct light: light sampling and BSDF sampling.
//                                                         [Lang, eq. 6.555-6.572; Veach and Guibas 1995; Veach 1997]
//
// A vertex has n light samples of density p_l and one BSDF sample of density p_b; with p_1 = n p_l and p_2 = p_b:
//
//   constant   w_i = 1/2
//   balance    w_i = p_i / (p_1 + p_2)
//   cutoff     0 where p_i is less than `cutoff` times the larger density, else balance among the others
//   power      w_i = p_i^power / (p_1^power + p_2^power)
//   maximum    1 for the larger density; equal densities share
//   partition  1 for light sampling wherever it has a density [Lang, Example 6.43]: next event estimation that does not
//              count lights hit by BSDF samples [Lang, Remark 9.6]
//
// A technique without density has the weight 0, and the other one 1. The weights have the sum 1 for all densities.
#pragma once
#include <array>
#include <cmath>

#include "transport/mis/mis.h"

namespace etendue::transport {

enum class DirectLightHeuristic : uint8_t { constant, balance, cutoff, power, maximum, partition };

struct DirectLightMis {
  DirectLightHeuristic heuristic = DirectLightHeuristic::power;
  float cutoff = 0.5f;    // of the cutoff heuristic, from 0 (balance) to 1 (maximum)
  float power = 2;        // of the power heuristic, above 0; 1 is balance
  int light_samples = 1;  // per vertex

  constexpr DirectLightMis() = default;
  constexpr DirectLightMis(DirectLightHeuristic chosen) : heuristic(chosen) {}  // NOLINT: with default parameters
  constexpr DirectLightMis(MisHeuristic chosen)                                 // NOLINT: of any number of techniques
      : heuristic(chosen == MisHeuristic::balance ? DirectLightHeuristic::balance
                  : chosen == MisHeuristic::power ? DirectLightHeuristic::power
                                                  : DirectLightHeuristic::maximum) {}

  // The weight of one of the light samples, divided by n p_l: the factor of its contribution. `light_pdf` is p_l > 0.
  float light_weight_over_pdf(float light_pdf, float bsdf_pdf) const {
    const float pdf = static_cast<float>(light_samples) * light_pdf;
    if (!is_square()) [[unlikely]]
      return general_weight(pdf, bsdf_pdf, true) / pdf;
    return mis_weight_over_pdf(MisHeuristic::power, pdf, bsdf_pdf);
  }
  // The weight of the BSDF sample.
  float bsdf_weight(float bsdf_pdf, float light_pdf) const {
    const float pdf = static_cast<float>(light_samples) * light_pdf;
    if (!is_square()) [[unlikely]]
      return general_weight(bsdf_pdf, pdf, false);
    return mis_weight(MisHeuristic::power, bsdf_pdf, pdf);
  }

  // The same heuristic for techniques with one sample each.
  DirectLightMis with_one_light_sample() const {
    DirectLightMis one = *this;
    one.light_samples = 1;
    return one;
  }

 private:
  // Densities that differ by less than rounding errors count as equal.
  static constexpr float kEqual = 1 - 1e-4f;

  bool is_square() const { return heuristic == DirectLightHeuristic::power && power == 2; }

  // The weight of density p against q; `of_light`: p belongs to light sampling.
  [[gnu::cold, gnu::noinline]] float general_weight(float p, float q, bool of_light) const {
    p = std::min(p, kLargestDensity);
    q = std::min(q, kLargestDensity);
    if (!(p > 0)) return 0;
    if (!(q > 0)) return 1;
    switch (heuristic) {
      case DirectLightHeuristic::constant:
        return 0.5f;
      case DirectLightHeuristic::balance:
        return p / (p + q);
      case DirectLightHeuristic::cutoff:
        return cutoff_weight(p, q, cutoff);
      case DirectLightHeuristic::power:
        return 1 / (1 + std::pow(q / p, power));
      case DirectLightHeuristic::maximum:
        return cutoff_weight(p, q, 1);
      case DirectLightHeuristic::partition:
        break;
    }
    return of_light ? 1.0f : 0.0f;
  }

  static float cutoff_weight(float p, float q, float cutoff) {
    const float threshold = kEqual * cutoff * std::max(p, q);
    if (p < threshold) return 0;
    return q < threshold ? 1 : p / (p + q);
  }
};

}  // namespace etendue::transport

template <>
struct etendue::Options<etendue::transport::DirectLightHeuristic> {
  static constexpr std::array<etendue::Option, 6> kOptions{{{"constant", "Constant (1/2)"},
                                                            {"balance", "Balance"},
                                                            {"cutoff", "Cutoff"},
                                                            {"power", "Power"},
                                                            {"maximum", "Maximum"},
                                                            {"partition", "Partition (light samples only)"}}};
};
