// A Henyey-Greenstein lobe with an isotropic part.                                            [Lang, sec. 4.2.4]
#pragma once
#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct ModifiedHenyeyGreenstein {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "modified-henyey-greenstein",
      .label = "Modified Henyey-Greenstein",
      .summary = "A Henyey-Greenstein lobe and a uniform part.",
      .formula = "p = b / (4 pi) + (1 - b) HG(g, x)",
      .mean_cosine = "(1 - b) g",
      .sampling = "Exact: the isotropic part with probability b, otherwise the lobe.",
      .limitations = "Asymmetries beyond +-0.999 are evaluated as +-0.999.",
      .source = "[Lang, sec. 4.2.4]",
  };

  Number<float> isotropic{"isotropic", "Isotropic part", 0.3f, {0, 1}, "Fraction b that scatters uniformly"};
  Number<float> g{"g",
                  "Asymmetry g",
                  0.6f,
                  {-1, 1},
                  "Mean cosine of the lobe. Higher scatters more forward; below 0 backward"};

  auto parameters() { return std::tie(isotropic, g); }

  double eval(double x) const {
    return isotropic * phase::kInv4Pi + (1.0 - isotropic) * phase::henyey_greenstein(g, x);
  }
  double sample(double u) const {
    return phase::select_first(isotropic, u) ? 2 * u - 1 : phase::sample_henyey_greenstein(g, u);
  }
  double mean_cosine() const { return (1.0 - isotropic) * phase::clamped_asymmetry(g); }
};

}  // namespace etendue
