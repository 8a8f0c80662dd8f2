// The phase function of Henyey and Greenstein.                            [Henyey and Greenstein 1941; Lang, sec. 4.2.4]
#pragma once
#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct HenyeyGreenstein {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "henyey-greenstein",
      .label = "Henyey-Greenstein",
      .summary = "One lobe, forward or backward; fits many natural media.",
      .formula = "p = (1 - g^2) / (4 pi (1 + g^2 - 2 g x)^(3/2))",
      .mean_cosine = "g",
      .sampling = "Exact: inverse of the distribution function.",
      .limitations = "Asymmetries beyond +-0.999 are evaluated as +-0.999, because p is a delta at 1.",
      .source = "[Henyey and Greenstein 1941] [Lang, sec. 4.2.4]",
  };

  Number<float> g{"g",
                  "Asymmetry g",
                  0.5f,
                  {-1, 1},
                  "Mean cosine of the scattering angle. Higher scatters more forward; below 0 backward"};

  auto parameters() { return std::tie(g); }

  double eval(double x) const { return phase::henyey_greenstein(g, x); }
  double sample(double u) const { return phase::sample_henyey_greenstein(g, u); }
  double mean_cosine() const { return phase::clamped_asymmetry(g); }
};

}  // namespace etendue
