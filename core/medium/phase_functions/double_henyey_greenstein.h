// Two Henyey-Greenstein lobes, usually one forward and one backward.                          [Kattawar 1975]
#pragma once
#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct DoubleHenyeyGreenstein {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "double-henyey-greenstein",
      .label = "Double Henyey-Greenstein",
      .summary = "A forward and a backward lobe; fits clouds and haze.",
      .formula = "p = w HG(g1, x) + (1 - w) HG(g2, x)",
      .mean_cosine = "w g1 + (1 - w) g2",
      .sampling = "Exact: the first lobe with probability w, otherwise the second.",
      .limitations = "Asymmetries beyond +-0.999 are evaluated as +-0.999.",
      .source = "[Kattawar 1975]",
  };

  Number<float> weight{"weight", "Weight", 0.8f, {0, 1}, "Fraction w scattered by the first lobe"};
  Number<float> g1{"g1", "First g", 0.8f, {-1, 1}, "Mean cosine of the first lobe. Higher scatters more forward"};
  Number<float> g2{"g2", "Second g", -0.4f, {-1, 1}, "Mean cosine of the second lobe. Higher scatters more forward"};

  auto parameters() { return std::tie(weight, g1, g2); }

  double eval(double x) const {
    return weight * phase::henyey_greenstein(g1, x) + (1.0 - weight) * phase::henyey_greenstein(g2, x);
  }
  double sample(double u) const {
    const double g = phase::select_first(weight, u) ? g1 : g2;
    return phase::sample_henyey_greenstein(g, u);
  }
  double mean_cosine() const {
    return weight * phase::clamped_asymmetry(g1) + (1.0 - weight) * phase::clamped_asymmetry(g2);
  }
};

}  // namespace etendue
