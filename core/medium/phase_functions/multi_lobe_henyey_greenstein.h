// A weighted sum of Henyey-Greenstein lobes.                                                  [Lang, sec. 4.2.4]
#pragma once
#include <array>

#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

struct MultiLobeHenyeyGreenstein {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "multi-lobe-henyey-greenstein",
      .label = "Multi-lobe Henyey-Greenstein",
      .summary = "Three Henyey-Greenstein lobes; forward, sideward and backward scattering at once.",
      .formula = "p = sum of w_i HG(g_i, x), the weights divided by their sum",
      .mean_cosine = "sum of w_i g_i",
      .sampling = "Exact: lobe i with probability w_i.",
      .limitations = "If all weights are 0 it is isotropic. Asymmetries beyond +-0.999 are evaluated as +-0.999.",
      .source = "[Lang, sec. 4.2.4]",
  };

  Number<float> w1{"w1", "First weight", 0.6f, {0, 1}, "Relative weight of the first lobe"};
  Number<float> g1{"g1", "First g", 0.85f, {-1, 1}, "Mean cosine of the first lobe. Higher scatters more forward"};
  Number<float> w2{"w2", "Second weight", 0.3f, {0, 1}, "Relative weight of the second lobe"};
  Number<float> g2{"g2", "Second g", 0.2f, {-1, 1}, "Mean cosine of the second lobe. Higher scatters more forward"};
  Number<float> w3{"w3", "Third weight", 0.1f, {0, 1}, "Relative weight of the third lobe"};
  Number<float> g3{"g3", "Third g", -0.5f, {-1, 1}, "Mean cosine of the third lobe. Higher scatters more forward"};

  auto parameters() { return std::tie(w1, g1, w2, g2, w3, g3); }

  double eval(double x) const {
    return weighted([x](double g) { return phase::henyey_greenstein(g, x); });
  }
  double sample(double u) const {
    const auto lobes = normalised();
    if (phase::select_first(lobes[0].weight, u)) return phase::sample_henyey_greenstein(lobes[0].g, u);
    const double rest = lobes[1].weight + lobes[2].weight;
    const bool second = phase::select_first(lobes[1].weight / rest, u);
    return phase::sample_henyey_greenstein(lobes[second ? 1 : 2].g, u);
  }
  double mean_cosine() const { return weighted(phase::clamped_asymmetry); }

 private:
  struct Lobe {
    double weight, g;
  };
  std::array<Lobe, 3> normalised() const {
    const double sum = double{w1} + w2 + w3;
    if (!(sum > 0)) return {{{1, 0}, {0, 0}, {0, 0}}};
    return {{{w1 / sum, g1}, {w2 / sum, g2}, {w3 / sum, g3}}};
  }
  template <class F>
  double weighted(F&& of_asymmetry) const {
    double sum = 0;
    for (const Lobe& lobe : normalised()) sum += lobe.weight * of_asymmetry(lobe.g);
    return sum;
  }
};

}  // namespace etendue
