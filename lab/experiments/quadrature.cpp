// Integrals over the unit cube by tensor products of one-dimensional rules, by random points and by quasi-random points
// [Lang, sec. 6.1, 6.2, 7.1]
//
// A rule with n panels per axis needs about N = n^s evaluations in s dimensions. If its error falls as n^-r, it falls as
// N^(-r/s): the curse of dimensionality. The error of random points falls as N^(-1/2) in every dimension. The orders r
// of the rules are
//
//                          smooth  kink  box
//   midpoint, trapezoid         2     2    1
//   Simpson                     4     2    1
//   Gauss, 2 points             4     2    1
//
// The errors of kink and box depend on the position of the kink or edge between two nodes. They are root mean squares
// over random positions. The slopes of tensor products are fitted over n^s, which is N without the nodes that panels
// share.
//
// A function that is not finite at a node has no tensor product with this node: `sinc` fails with trapezoid and Simpson.
#include "equations/quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "experiments/error_curves.h"
#include "experiments/test_integrands.h"
#include "experiments/uniform_points.h"

namespace etendue::experiments {
namespace {

using equations::QuadratureRule;
using equations::RandomNumbers;

constexpr Repeats kQuadratureRepeats{.groups = 8, .per_group = 16};
constexpr double kLargestSlopeError = 0.05;    // of a slope that is compared
constexpr double kQuadratureRounding = 1e-13;  // errors below this are rounding errors

struct TensorRule {
  const char* name;
  QuadratureRule (*make)(int panels);
  int smooth_order, kink_order;
};
constexpr TensorRule kTensorRules[] = {
    {"midpoint", equations::midpoint_rule, 2, 2},
    {"trapezoid", equations::trapezoid_rule, 2, 2},
    {"Simpson", equations::simpson_rule, 4, 2},
    {"Gauss, 2 points", [](int panels) { return equations::gauss_rule(2, panels); }, 4, 2}};

struct Quadrature {
  static constexpr ExperimentDescription kDescription{
      .name = "quadrature",
      .label = "Quadrature",
      .summary =
          "The error of tensor product rules, random points and quasi-random points over the number of evaluations",
      .source = "[Lang, sec. 6.1-6.2, eq. 6.21, 6.23, 6.30]"};

  Number<int> dimension{"dimension", "Dimension", 2, {1, 64}, "Number of variables of the integrand"};
  Choice<IntegrandKind> integrand{"integrand", "Integrand", IntegrandKind::smooth, "The function that is integrated"};
  Number<int> evaluations{"evaluations",
                          "Evaluations",
                          16384,
                          {64, 4194304},
                          "Largest number of evaluations of the integrand for one estimate. Higher is slower",
                          "",
                          Scale::logarithmic};
  Text sampler = sampler_parameter("The sampler that supplies the quasi-random points");
  auto parameters() { return std::tie(dimension, integrand, evaluations, sampler); }

  Result<ExperimentResult> run(const RunContext& context) const {
    ExperimentResult result;
    result.table.columns = {"method", "evaluations", "RMS error", "slope", "standard error"};
    ErrorChart chart{.title = title(), .work = "evaluations", .curves = {}};
    for (const TensorRule& rule : kTensorRules) {
      auto curves = tensor_curves(rule, context);
      if (!curves) return curves.error();
      if (curves->repeats.front().points.empty()) {
        result.notes.push_back(std::string(rule.name) + ": 2 panels per axis need more evaluations than permitted.");
        continue;
      }
      add_tensor_checks(rule, *curves, result);
      chart.curves.push_back(std::move(*curves));
    }
    for (const bool quasi : {false, true}) {
      auto curves = point_curves(quasi, context);
      if (!curves) return curves.error();
      const auto s = slope(*curves);
      // In many dimensions the variance of the smooth integrand is too large for an estimate of the slope.
      if (!quasi && s.known && s.standard_error < kLargestSlopeError)
        result.checks.push_back(
            {"random: slope over evaluations", s.value, -0.5, std::max(0.05, 3 * s.standard_error)});
      add_row(*curves, s, result);
      chart.curves.push_back(std::move(*curves));
    }
    result.charts.emplace_back(std::move(chart));
    return result;
  }

 private:
  std::string title() const {
    return std::string(Options<IntegrandKind>::kOptions[static_cast<size_t>(integrand.value)].label) + " in " +
           std::to_string(dimension) + (dimension == 1 ? " dimension" : " dimensions");
  }

  static void add_row(const metrics::MethodCurves& curves, const metrics::Estimate& s, ExperimentResult& result) {
    const auto end = metrics::curve_end(curves, metrics::Abscissa::samples, film::ErrorMeasure::rmse);
    result.table.rows.push_back({curves.name, end.spp, end.point ? end.point->median : 0.0, s.known ? s.value : NAN,
                                 s.degrees > 0 ? s.standard_error : NAN});
  }

  // Numbers of panels per axis whose tensor product is affordable, about sqrt(2) apart.
  std::vector<int> panel_counts(const TensorRule& rule) const {
    std::vector<int> counts;
    for (double n = 2; equations::tensor_evaluations(rule.make(static_cast<int>(n)), dimension) <= evaluations;
         n = std::max(n + 1, std::round(n * std::numbers::sqrt2)))
      counts.push_back(static_cast<int>(n));
    return counts;
  }

  Result<metrics::MethodCurves> tensor_curves(const TensorRule& rule, const RunContext& context) const {
    std::vector<QuadratureRule> rules;
    std::vector<double> work;
    for (const int n : panel_counts(rule)) {
      rules.push_back(rule.make(n));
      work.push_back(equations::tensor_evaluations(rules.back(), dimension));
    }
    std::optional<Error> failure;
    const auto errors = [&](int repeat, std::span<double> out) {
      RandomNumbers random(mix_bits(context.seed) + static_cast<uint64_t>(repeat));
      const TestIntegrand f = make_integrand(integrand, dimension, random);
      for (size_t k = 0; k < rules.size() && !failure; ++k) {
        const auto sum = equations::integrate(rules[k], dimension, f.value);
        if (sum)
          out[k] = *sum - f.integral;
        else
          failure = input_error(std::string(rule.name) + ": " + sum.error().message);
      }
    };
    const Repeats repeats = is_random(integrand) ? kQuadratureRepeats : Repeats{.groups = 1, .per_group = 1};
    auto curves = rms_error_curves(rule.name, work, repeats, errors, context);
    if (failure) return *failure;
    return curves;
  }

  // The slope over n^s from four panels per axis on, where the theory has an order.
  void add_tensor_checks(const TensorRule& rule, const metrics::MethodCurves& curves, ExperimentResult& result) const {
    metrics::MethodCurves over_cells = curves;
    const auto counts = panel_counts(rule);
    for (auto& curve : over_cells.repeats)
      for (size_t k = 0; k < curve.points.size(); ++k)
        curve.points[k].spp = std::pow(static_cast<double>(counts[k]), dimension.value);
    const auto s = slope(over_cells, std::pow(4.0, dimension.value), kQuadratureRounding);
    add_row(curves, s, result);
    const bool has_order = integrand == IntegrandKind::smooth || (is_random(integrand) && dimension == 1);
    if (!has_order || !s.known || counts.back() < 16) return;
    const int order = integrand == IntegrandKind::smooth ? rule.smooth_order
                      : integrand == IntegrandKind::kink ? rule.kink_order
                                                         : 1;
    result.checks.push_back({std::string(rule.name) + ": slope over n^s", s.value,
                             -static_cast<double>(order) / dimension, std::max(0.05, 3 * s.standard_error)});
  }

  // Random points, or the points of the sampler with another randomisation in each repeat.
  Result<metrics::MethodCurves> point_curves(bool quasi, const RunContext& context) const {
    const int last = static_cast<int>(std::log2(evaluations.value));
    const std::vector<double> work = powers_of_two(2, last);
    const auto count = static_cast<uint32_t>(work.back());
    const UniformPoints points(quasi ? sampler.value : "random", count);
    std::vector<double> x(static_cast<size_t>(dimension.value));
    std::optional<Error> failure;
    const auto errors = [&](int repeat, std::span<double> out) {
      RandomNumbers random(mix_bits(context.seed) + static_cast<uint64_t>(repeat));
      const TestIntegrand f = make_integrand(integrand, dimension, random);
      const uint32_t seed = hash_combine(static_cast<uint32_t>(context.seed), static_cast<uint32_t>(repeat));
      double sum = 0;
      size_t k = 0;
      for (uint32_t i = 0; i < count && !failure; ++i) {
        points.point(seed, i, x);
        const double value = f.value(x);
        if (!std::isfinite(value))
          failure = input_error("the integrand is not finite at x = " + equations::point_text(x));
        sum += value;
        if (i + 1 == static_cast<uint32_t>(work[k])) out[k++] = sum / (i + 1) - f.integral;
      }
    };
    auto curves = rms_error_curves(quasi ? sampler.value : "random points", work, kQuadratureRepeats, errors, context);
    if (failure) return *failure;
    return curves;
  }
};

}  // namespace

Experiment quadrature_experiment() { return make_experiment<Quadrature>(); }

}  // namespace etendue::experiments
