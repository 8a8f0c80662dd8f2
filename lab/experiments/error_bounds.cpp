// How often the error of a mean of N samples exceeds t standard deviations, and the bounds of theory
//
//   Chebyshev             P(|F_N - I| >= t sigma) <= 1 / t^2          [Lang, eq. 6.205]
//   central limit theorem P(|F_N - I| >= t sigma) -> erfc(t / sqrt 2) [Lang, eq. 6.214]
//
// Chebyshev's bound holds for every N and every integrand of finite variance, and is far from sharp. The normal
// distribution is a limit: for the integrand `rare`, which is 1 with probability 1/1000, it is wrong as long as the
// samples contain few ones.
#include <algorithm>
#include <cmath>

#include "equations/random_numbers.h"
#include "experiments/experiment.h"
#include "experiments/moments.h"

namespace etendue::experiments {

enum class BoundedIntegrand { square, rare };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::BoundedIntegrand> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"square", "x\u00b2"}, {"rare", "1 for x < 0.001"}}};
};

namespace etendue::experiments {
namespace {

constexpr double kRareShare = 0.001;
constexpr double kLargestDeviation = 5;  // of the chart, in standard deviations

struct ErrorBounds {
  static constexpr ExperimentDescription kDescription{
      .name = "error-bounds",
      .label = "Bounds of the error of a mean",
      .summary =
          "How often errors exceed a multiple of the standard deviation, against Chebyshev's inequality and the "
          "central limit theorem",
      .source = "[Lang, eq. 6.205, 6.214]"};

  Choice<BoundedIntegrand> integrand{"integrand", "Integrand", BoundedIntegrand::square,
                                     "A smooth integrand, or one that is rarely not zero"};
  Number<int> samples{"samples", "Samples", 64, {1, 65536}, "Number of samples of a mean", "", Scale::logarithmic};
  Number<int> repeats{"repeats",
                      "Repeats",
                      20000,
                      {100, 1000000},
                      "Number of means whose errors are counted. Higher shows rarer errors",
                      "",
                      Scale::logarithmic};
  auto parameters() { return std::tie(integrand, samples, repeats); }

  Result<ExperimentResult> run(const RunContext& context) const {
    std::vector<double> deviations;
    const double sigma = std::sqrt(variance() / samples);
    for (int r = 0; r < repeats; ++r) {
      if (r % 256 == 0 && !context.proceed(static_cast<double>(r) / repeats)) return interrupted();
      equations::RandomNumbers random(mix_bits(context.seed) + static_cast<uint64_t>(r));
      double sum = 0;
      for (int i = 0; i < samples; ++i) sum += value(random.uniform());
      deviations.push_back(std::abs(sum / samples - integral()) / sigma);
    }
    return summary(deviations);
  }

 private:
  double value(double x) const {
    if (integrand == BoundedIntegrand::square) return x * x;
    return x < kRareShare ? 1 : 0;
  }
  double integral() const { return integrand == BoundedIntegrand::square ? 1.0 / 3 : kRareShare; }
  double variance() const { return integrand == BoundedIntegrand::square ? 4.0 / 45 : kRareShare * (1 - kRareShare); }

  static double normal(double t) { return std::erfc(t / std::sqrt(2.0)); }
  static double chebyshev(double t) { return std::min(1.0, 1 / (t * t)); }

  double observed(const std::vector<double>& deviations, double t) const {
    return static_cast<double>(std::ranges::count_if(deviations, [t](double d) { return d >= t; })) / repeats;
  }

  ExperimentResult summary(const std::vector<double>& deviations) const {
    ExperimentResult result;
    metrics::FunctionCurve frequency{.name = "observed", .points = {}};
    metrics::FunctionCurve limit{.name = "central limit theorem", .style = metrics::CurveStyle::dashed, .points = {}};
    metrics::FunctionCurve bound{.name = "Chebyshev", .style = metrics::CurveStyle::dashed, .points = {}};
    for (double t = 0.125; t <= kLargestDeviation; t += 0.125) {
      frequency.points.push_back({t, observed(deviations, t)});
      if (normal(t) > 0.1 / repeats) limit.points.push_back({t, normal(t)});
      bound.points.push_back({t, chebyshev(t)});
    }
    result.charts = {metrics::FunctionChart{.title = "Frequency of errors of " + std::to_string(samples) + " samples",
                                            .x_label = "error in standard deviations",
                                            .y_label = "frequency of larger errors",
                                            .curves = {frequency, limit, bound},
                                            .logarithmic_y = true}};
    result.table.columns = {"standard deviations", "observed", "central limit theorem", "Chebyshev"};
    for (const double t : {1.0, 1.5, 2.0, 3.0, 4.0}) {
      const double share = observed(deviations, t);
      result.table.rows.push_back({t, share, normal(t), chebyshev(t)});
      const double error = kStandardErrors * std::sqrt(normal(t) * (1 - normal(t)) / repeats) + 1.0 / repeats;
      // Bounds the terms of order 1/N of the Edgeworth series for the square.
      const double finite = std::exp(-t * t / 2) * t * t * t / (8.0 * samples);
      if (integrand == BoundedIntegrand::square && samples >= 64)
        result.checks.push_back(
            {"frequency of errors above " + cell_number(t) + " sigma", share, normal(t), error + finite});
    }
    return result;
  }

  static std::string cell_number(double t) { return metrics::short_number(t); }
};

}  // namespace

Experiment error_bounds_experiment() { return make_experiment<ErrorBounds>(); }

}  // namespace etendue::experiments
