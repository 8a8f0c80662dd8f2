// Nishita's approximation of Lorenz-Mie scattering in a murky atmosphere.           [Nishita et al. 1987; Lang, sec. 4.2.4]
#pragma once
#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct MieMurky {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "mie-murky",
      .label = "Lorenz-Mie, murky",
      .summary = "Particles as large as the wavelength, at high density, such as droplets of fog.",
      .formula = "p = (1 / 2 + 33 / 2 ((1 + x) / 2)^32) / (4 pi)",
      .mean_cosine = "8 / 17",
      .sampling = "Exact: half isotropic, half (1 + x) / 2 = u^(1/33).",
      .limitations = "An empirical fit without parameters.",
      .source = "[Nishita et al. 1987] [Lang, sec. 4.2.4]",
  };

  auto parameters() { return std::tie(); }

  double eval(double x) const { return phase::kInv4Pi * (0.5 + 16.5 * std::pow(0.5 * (1 + x), 32)); }
  double sample(double u) const {
    return phase::select_first(0.5, u) ? 2 * u - 1 : 2 * std::pow(u, 1.0 / 33) - 1;
  }
  double mean_cosine() const { return 8.0 / 17; }
};

}  // namespace etendue
