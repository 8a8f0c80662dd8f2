// Isotropic scattering: the volume counterpart of Lambert's model.                            [Lang, sec. 4.2.4]
#pragma once
#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct IsotropicPhase {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "isotropic",
      .label = "Isotropic",
      .summary = "Scatters equally into all directions.",
      .formula = "p = 1 / (4 pi)",
      .mean_cosine = "0",
      .sampling = "Exact: x = 2 u - 1.",
      .limitations = "",
      .source = "[Lang, sec. 4.2.4]",
  };

  auto parameters() { return std::tie(); }

  double eval(double) const { return phase::kInv4Pi; }
  double sample(double u) const { return 2 * u - 1; }
  double mean_cosine() const { return 0; }
};

}  // namespace etendue
