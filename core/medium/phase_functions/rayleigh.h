// Rayleigh scattering: particles up to a tenth of the wavelength.                  [Rayleigh 1871; Lang, sec. 4.2.4]
#pragma once
#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct RayleighPhase {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "rayleigh",
      .label = "Rayleigh",
      .summary = "Scattering by molecules, which makes the sky blue.",
      .formula = "p = 3 (1 + x^2) / (16 pi)",
      .mean_cosine = "0",
      .sampling = "Exact: the cubic of the distribution function solved by Cardano's formula.",
      .limitations = "The dependence of the coefficient on the wavelength (power -4) belongs to the medium.",
      .source = "[Rayleigh 1871] [Lang, sec. 4.2.4]",
  };

  auto parameters() { return std::tie(); }

  double eval(double x) const { return phase::kInv4Pi * 0.75 * (1 + x * x); }
  double sample(double u) const {
    // Solved for the upper half, where nothing cancels.
    const bool lower = u < 0.5;
    const double q = lower ? 2 - 4 * u : 4 * u - 2, a = std::cbrt(q + std::sqrt(q * q + 1)), x = a - 1 / a;
    return std::clamp(lower ? -x : x, -1.0, 1.0);
  }
  double mean_cosine() const { return 0; }
};

}  // namespace etendue
