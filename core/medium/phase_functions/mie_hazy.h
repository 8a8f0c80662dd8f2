// Nishita's approximation of Lorenz-Mie scattering in a hazy atmosphere.            [Nishita et al. 1987; Lang, sec. 4.2.4]
//
// The exponent is 8. The thesis prints 2, for which the integral is 2 instead of 1.
#pragma once
#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct MieHazy {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "mie-hazy",
      .label = "Lorenz-Mie, hazy",
      .summary = "Particles as large as the wavelength, at low density.",
      .formula = "p = (1 / 2 + 9 / 2 ((1 + x) / 2)^8) / (4 pi)",
      .mean_cosine = "0.4",
      .sampling = "Exact: half isotropic, half (1 + x) / 2 = u^(1/9).",
      .limitations = "An empirical fit without parameters.",
      .source = "[Nishita et al. 1987] [Lang, sec. 4.2.4]",
  };

  auto parameters() { return std::tie(); }

  double eval(double x) const { return phase::kInv4Pi * (0.5 + 4.5 * std::pow(0.5 * (1 + x), 8)); }
  double sample(double u) const {
    return phase::select_first(0.5, u) ? 2 * u - 1 : 2 * std::pow(u, 1.0 / 9) - 1;
  }
  double mean_cosine() const { return 0.4; }
};

}  // namespace etendue
