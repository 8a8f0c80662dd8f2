// Riemann and Lebesgue sums [Lang, eq. 2.212-2.215]
//
// A Riemann sum divides the domain into n intervals and uses the infimum or supremum of f in each of them. A Lebesgue sum
// divides the values into n levels y_i and uses the measure of the set where f exceeds each of them:
//
//   L_n = (1/n) sum over i of  measure of {x : f(x) >= i/n},   0 <= f <= 1
//
// For a Riemann integrable function all three converge, and their errors are at most (sup f - inf f)/n for monotone f.
// The function of Dirichlet is 1 at rational and 0 at irrational numbers. Every interval contains both, so its upper
// Riemann sum is 1 and its lower one 0 for every n. Its Lebesgue integral is 0. The infimum, the supremum and the measure
// are exact here, because a computer can represent rational numbers only.
#include <cmath>

#include "experiments/error_curves.h"

namespace etendue::experiments {

enum class SummedFunction { square, steps, dirichlet };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::SummedFunction> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"square", "x\u00b2"}, {"steps", "Staircase of three steps"}, {"dirichlet", "Function of Dirichlet"}}};
};

namespace etendue::experiments {
namespace {

// A function with values in [0, 1], described by what the sums need.
struct Summable {
  double (*infimum)(double a, double b);  // in [a, b)
  double (*supremum)(double a, double b);
  double (*measure)(double y);  // of the set where f >= y, y > 0
  double riemann, lebesgue;     // the integrals; NaN if there is none
};

double staircase(double x) { return std::floor(3 * x) / 3; }

Summable summable(SummedFunction function) {
  switch (function) {
    case SummedFunction::square:
      return {[](double a, double) { return a * a; }, [](double, double b) { return b * b; },
              [](double y) { return 1 - std::sqrt(y); }, 1.0 / 3, 1.0 / 3};
    case SummedFunction::steps:
      return {[](double a, double) { return staircase(a); },
              [](double, double b) { return staircase(std::nextafter(b, 0.0)); },
              [](double y) { return std::max(0.0, 1 - std::ceil(3 * y - 1e-12) / 3); }, 1.0 / 3, 1.0 / 3};
    case SummedFunction::dirichlet:
      break;
  }
  return {[](double, double) { return 0.0; }, [](double, double) { return 1.0; }, [](double) { return 0.0; }, NAN, 0};
}

struct LebesgueSums {
  static constexpr ExperimentDescription kDescription{
      .name = "lebesgue-sums",
      .label = "Riemann and Lebesgue sums",
      .summary =
          "Sums that divide the domain of a function and sums that divide its values, also for a function without "
          "Riemann integral",
      .source = "[Lang, eq. 2.212-2.215]"};

  Choice<SummedFunction> function{"function", "Function", SummedFunction::square, "The function that is integrated"};
  Number<int> parts{"parts", "Parts",           1024, {2, 1048576}, "Largest number of intervals or levels",
                    "",      Scale::logarithmic};
  auto parameters() { return std::tie(function, parts); }

  Result<ExperimentResult> run(const RunContext&) const {
    const Summable f = summable(function);
    const auto work = powers_of_two(1, static_cast<int>(std::log2(parts.value)));
    ExperimentResult result;
    result.table.columns = {"parts", "lower Riemann sum", "upper Riemann sum", "Lebesgue sum"};
    metrics::FunctionCurve lower{.name = "lower Riemann sum", .points = {}};
    metrics::FunctionCurve upper{.name = "upper Riemann sum", .points = {}};
    metrics::FunctionCurve lebesgue{.name = "Lebesgue sum", .points = {}};
    for (const double n : work) {
      const Sums s = sums(f, static_cast<int>(n));
      lower.points.push_back({n, s.lower});
      upper.points.push_back({n, s.upper});
      lebesgue.points.push_back({n, s.lebesgue});
      result.table.rows.push_back({n, s.lower, s.upper, s.lebesgue});
    }
    add_checks(f, work.back(), lower.points.back().y, upper.points.back().y, lebesgue.points.back().y, result);
    result.charts = {metrics::FunctionChart{.title = "Riemann and Lebesgue sums",
                                            .x_label = "parts",
                                            .y_label = "sum",
                                            .curves = {lower, upper, lebesgue},
                                            .logarithmic_x = true}};
    return result;
  }

 private:
  struct Sums {
    double lower = 0, upper = 0, lebesgue = 0;
  };

  static Sums sums(const Summable& f, int n) {
    Sums s;
    for (int i = 0; i < n; ++i) {
      const double a = static_cast<double>(i) / n, b = static_cast<double>(i + 1) / n;
      s.lower += f.infimum(a, b) / n;
      s.upper += f.supremum(a, b) / n;
      s.lebesgue += f.measure(b) / n;
    }
    return s;
  }

  static void add_checks(const Summable& f, double n, double lower, double upper, double lebesgue,
                         ExperimentResult& result) {
    result.checks.push_back({"Lebesgue sum", lebesgue, f.lebesgue, 1 / n});
    if (std::isnan(f.riemann)) {
      result.checks.push_back({"lower Riemann sum", lower, 0, 0});
      result.checks.push_back({"upper Riemann sum", upper, 1, 1e-12});
      result.notes.push_back(
          "The lower and the upper Riemann sum have different limits: there is no Riemann integral.");
      return;
    }
    result.checks.push_back({"lower Riemann sum", lower, f.riemann, 1 / n});
    result.checks.push_back({"upper Riemann sum", upper, f.riemann, 1 / n});
  }
};

}  // namespace

Experiment lebesgue_sums_experiment() { return make_experiment<LebesgueSums>(); }

}  // namespace etendue::experiments
