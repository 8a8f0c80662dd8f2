// The phase function of Cornette and Shanks: Henyey-Greenstein times the Rayleigh factor.     [Cornette and Shanks 1992]
#pragma once
#include <array>

#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct CornetteShanks {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "cornette-shanks",
      .label = "Cornette-Shanks",
      .summary = "Henyey-Greenstein corrected for small particles: Rayleigh scattering at g = 0.",
      .formula = "p = 3 (1 - g^2) (1 + x^2) / (8 pi (2 + g^2) (1 + g^2 - 2 g x)^(3/2))",
      .mean_cosine = "3 g (4 + g^2) / (5 (2 + g^2))",
      .sampling = "Bisection and Newton steps on the distribution function, to rounding accuracy.",
      .limitations = "Asymmetries beyond +-0.999 are evaluated as +-0.999.",
      .source = "[Cornette and Shanks 1992]",
  };

  Number<float> g{"g", "Asymmetry g", 0.5f, {-1, 1}, "Higher scatters more forward; below 0 backward"};

  auto parameters() { return std::tie(g); }

  double eval(double x) const {
    const double a = asymmetry();
    return 1.5 * (1 + x * x) / (2 + a * a) * phase::henyey_greenstein(a, x);
  }
  double sample(double u) const {
    double low = -1, high = 1, x = phase::sample_henyey_greenstein(asymmetry(), u);
    for (int i = 0; i < kMaxSteps && high - low > 1e-15; ++i) {
      const double excess = cumulative(x) - u;
      if (std::abs(excess) < 1e-15) break;
      (excess > 0 ? high : low) = x;
      const double density = 4 * std::numbers::pi * eval(x) / 2, next = x - excess / density;
      x = next > low && next < high ? next : 0.5 * (low + high);
    }
    return x;
  }
  double mean_cosine() const {
    const double a = asymmetry();
    return 3 * a * (4 + a * a) / (5 * (2 + a * a));
  }

 private:
  static constexpr int kMaxSteps = 100;

  double asymmetry() const { return phase::clamped_asymmetry(g); }

  // The distribution function, 2 pi times the integral of p from -1 to x.
  double cumulative(double x) const { return std::abs(asymmetry()) < 0.1 ? by_quadrature(x) : in_closed_form(x); }

  // With y^2 = 1 + g^2 - 2 g x, the integrand (1 + x^2) / y^3 is a polynomial in y over y^2.
  double in_closed_form(double x) const {
    const double a = asymmetry(), b = (1 + a * a) / (2 * a), c = 1 / (2 * a);
    const auto primitive = [&](double y) { return (1 + b * b) / y + 2 * b * c * y - c * c * y * y * y / 3; };
    const double end = std::sqrt(std::max(1 + a * a - 2 * a * x, (1 - std::abs(a)) * (1 - std::abs(a))));
    return 0.75 * (1 - a * a) / (2 + a * a) * (primitive(end) - primitive(1 + a)) / a;
  }

  // The closed form cancels for small g, where the integrand is smooth: ten points of Gauss-Legendre quadrature.
  double by_quadrature(double x) const {
    constexpr std::array<double, 5> kNodes{0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                           0.8650633666889845, 0.9739065285171717},
        kWeights{0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806, 0.0666713443086881};
    const double middle = 0.5 * (x - 1), half = 0.5 * (x + 1);
    double sum = 0;
    for (size_t i = 0; i < kNodes.size(); ++i)
      sum += kWeights[i] * (eval(middle + half * kNodes[i]) + eval(middle - half * kNodes[i]));
    return 2 * std::numbers::pi * half * sum;
  }
};

}  // namespace etendue
