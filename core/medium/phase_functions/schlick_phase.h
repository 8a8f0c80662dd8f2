// Schlick's approximation of the Henyey-Greenstein function.                    [Blasi et al. 1993; Lang, sec. 4.2.4]
//
// The denominator contains 1 - k x, so that positive k scatter forward; the thesis prints 1 + k x for the same
// convention of angles, which would scatter backward.
#pragma once
#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct SchlickPhase {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "schlick",
      .label = "Schlick",
      .summary = "An ellipse that approximates Henyey-Greenstein without a root; k = 1.55 g - 0.55 g^3.",
      .formula = "p = (1 - k^2) / (4 pi (1 - k x)^2)",
      .mean_cosine = "(2 k - (1 - k^2) ln((1 + k) / (1 - k))) / (2 k^2)",
      .sampling = "Exact: x = (2 u + k - 1) / (2 k u - k + 1).",
      .limitations = "Values beyond +-0.999 are evaluated as +-0.999.",
      .source = "[Blasi et al. 1993] [Lang, sec. 4.2.4]",
  };

  Number<float> k{"k", "Eccentricity k", 0.7f, {-1, 1}, "Higher scatters more forward; below 0 backward"};

  auto parameters() { return std::tie(k); }

  double eval(double x) const {
    const double e = eccentricity(), d = 1 - e * x;
    return phase::kInv4Pi * (1 - e * e) / (d * d);
  }
  double sample(double u) const {
    const double e = eccentricity();
    return std::clamp((2 * u + e - 1) / (2 * e * u - e + 1), -1.0, 1.0);
  }
  double mean_cosine() const {
    const double e = eccentricity();
    // The closed form cancels near 0; its power series is used there.
    if (std::abs(e) < 0.02) return e * (2.0 / 3 + e * e * (2.0 / 15 + e * e * 2.0 / 35));
    return (2 * e - (1 - e * e) * std::log((1 + e) / (1 - e))) / (2 * e * e);
  }

 private:
  double eccentricity() const { return phase::clamped_asymmetry(k); }
};

}  // namespace etendue
