// Estimators of the integral of cos over [0, pi/2] with three densities [Lang, eq. 6.115-6.119, corrected]
//
//   F_N = (1/N) sum of cos(X_i) / p(X_i)
//
// F_1 is the primary estimator, F_N the secondary one. N Var F_N does not depend on N:
//
//   uniform     p = 2/pi                pi^2/8 - 1 = 0.2337
//   decreasing  p = 8 (pi/2 - x)/pi^2   0.01674
//   increasing  p = 8 x/pi^2            infinite, because cos(x)^2 / p diverges at 0 as 1/x
//
// All three are unbiased and converge, because the strong law of large numbers needs no variance. The means of the third
// one jump at rare large values, and its sample variance grows with the number of samples.
#include <cmath>
#include <numbers>

#include "equations/random_numbers.h"
#include "experiments/error_curves.h"
#include "experiments/moments.h"

namespace etendue::experiments {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

struct CosineEstimator {
  const char* name;
  double (*primary)(double u);  // cos(X) / p(X) with X made from u in (0, 1]
  double variance;              // of F_1
};
constexpr double kUnknownVariance = INFINITY;
constexpr CosineEstimator kCosineEstimators[] = {
    {"uniform", [](double u) { return kQuarterTurn * std::cos(kQuarterTurn * u); },
     std::numbers::pi* std::numbers::pi / 8 - 1},
    {"decreasing",
     [](double u) {
       const double distance = kQuarterTurn * std::sqrt(u);  // from pi/2
       return std::sin(distance) * kQuarterTurn * kQuarterTurn / (2 * distance);
     },
     0.016740514823445},
    {"increasing",
     [](double u) {
       const double x = kQuarterTurn * std::sqrt(u);
       return std::cos(x) * kQuarterTurn * kQuarterTurn / (2 * x);
     },
     kUnknownVariance}};

struct Estimators {
  static constexpr ExperimentDescription kDescription{
      .name = "estimators",
      .label = "Primary and secondary estimators",
      .summary = "Running means and errors of three Monte Carlo estimators, one of which has infinite variance",
      .source = "[Lang, eq. 6.103, 6.115-6.119]"};

  Number<int> samples{"samples", "Samples",         4096, {64, 1048576}, "Number of samples of a secondary estimator",
                      "",        Scale::logarithmic};
  auto parameters() { return std::tie(samples); }

  Result<ExperimentResult> run(const RunContext& context) const {
    ExperimentResult result;
    result.table.columns = {"density", "N Var, measured", "N Var, theory", "slope of the error", "mean"};
    metrics::FunctionChart running{
        .title = "Running means", .x_label = "samples", .y_label = "estimate", .curves = {}, .logarithmic_x = true};
    ErrorChart errors{.title = "Error of secondary estimators", .work = "samples", .curves = {}};
    for (const CosineEstimator& e : kCosineEstimators) {
      running.curves.push_back(running_mean(e, context.seed));
      auto curves = error_curves_of(e, context);
      if (!curves) return curves.error();
      add_numbers(e, *curves, context.seed, result);
      errors.curves.push_back(std::move(*curves));
    }
    running.curves.push_back({.name = "integral",
                              .style = metrics::CurveStyle::dashed,
                              .points = {{1, 1}, {static_cast<double>(samples.value), 1}}});
    result.notes.push_back(
        "The density 8 x / pi^2 gives infinite variance: its measured N Var grows with the samples.");
    result.charts = {std::move(running), std::move(errors)};
    return result;
  }

 private:
  static equations::RandomNumbers numbers_for(const CosineEstimator& e, uint64_t seed, uint64_t repeat) {
    return equations::RandomNumbers(mix_bits(seed) +
                                    mix_bits(repeat * 4 + static_cast<uint64_t>(&e - kCosineEstimators)));
  }

  metrics::FunctionCurve running_mean(const CosineEstimator& e, uint64_t seed) const {
    metrics::FunctionCurve curve{.name = e.name, .points = {}};
    auto random = numbers_for(e, seed, 0);
    double sum = 0, next = 1;
    for (int i = 1; i <= samples; ++i) {
      sum += e.primary(1 - random.uniform());
      if (i < next && i < samples) continue;
      curve.points.push_back({static_cast<double>(i), sum / i});
      next *= 1.05;
    }
    return curve;
  }

  Result<metrics::MethodCurves> error_curves_of(const CosineEstimator& e, const RunContext& context) const {
    const auto work = powers_of_two(2, static_cast<int>(std::log2(samples.value)));
    const auto errors = [&](int repeat, std::span<double> out) {
      auto random = numbers_for(e, context.seed, static_cast<uint64_t>(repeat) + 1);
      double sum = 0;
      size_t k = 0;
      for (int i = 1; k < work.size(); ++i) {
        sum += e.primary(1 - random.uniform());
        if (i == static_cast<int>(work[k])) out[k++] = sum / i - 1;
      }
    };
    return rms_error_curves(e.name, work, {}, errors, context);
  }

  void add_numbers(const CosineEstimator& e, const metrics::MethodCurves& curves, uint64_t seed,
                   ExperimentResult& result) const {
    Moments moments;
    auto random = numbers_for(e, seed, 0);
    for (int i = 0; i < samples; ++i) moments.add(e.primary(1 - random.uniform()));
    const auto s = slope(curves);
    result.table.rows.push_back({std::string(e.name), moments.variance(),
                                 std::isfinite(e.variance) ? Table::Cell(e.variance) : Table::Cell("infinite"), s.value,
                                 moments.mean()});
    if (!std::isfinite(e.variance)) return;
    const std::string name = e.name;
    result.checks.push_back(
        {name + ": N Var", moments.variance(), e.variance, kStandardErrors * moments.variance_error()});
    result.checks.push_back({name + ": mean", moments.mean(), 1, kStandardErrors * moments.mean_error()});
    result.checks.push_back({name + ": slope of the error", s.value, -0.5, std::max(0.05, 3 * s.standard_error)});
  }
};

}  // namespace

Experiment estimators_experiment() { return make_experiment<Estimators>(); }

}  // namespace etendue::experiments
