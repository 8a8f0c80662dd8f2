// Asymptotic approximations and series, and the digits that they lose [Lang, eq. 6.3-6.7]
//
// The integral of exp(-x^2) over [0, b] is the sum of the Taylor series
//
//   s_m = sum over n = 0 ... m of  (-1)^n b^(2n+1) / ((2n+1) n!)
//
// which converges for every b. Its terms grow up to about exp(b^2) before they fall, and they cancel to a number below
// one. Every term is rounded to 53 bits, so the converged sum has an error of about 2^-53 times the largest term: for
// b = 6 two digits are right, for b = 7 none are. Sums of few terms have large errors unless b is small.
//
// Stirling's formula n! ~ (n/e)^n sqrt(2 pi n) has the relative error -1/(12 n), plus terms of higher order. It becomes better
// with n, and not with the number of its terms.
#include <cmath>
#include <numbers>

#include "experiments/experiment.h"

namespace etendue::experiments {
namespace {

struct TaylorSum {
  double sum = 0, largest = 0;  // of the terms
  int terms = 0;
};

// Of terms 0 to `last`, or until they no longer change the sum. `term_added` is called after each of them.
template <class F>
TaylorSum taylor_sum(double b, int last, F&& term_added) {
  TaylorSum result;
  double power = b;  // (-1)^n b^(2n+1) / n!
  for (int n = 0; n <= last; ++n) {
    if (n > 0) power *= -b * b / n;
    const double term = power / (2 * n + 1), before = result.sum;
    result.sum += term;
    result.largest = std::max(result.largest, std::abs(term));
    ++result.terms;
    term_added(n, result.sum);
    if (result.sum == before && n > b * b) break;
  }
  return result;
}

double gauss_integral(double b) { return std::sqrt(std::numbers::pi) / 2 * std::erf(b); }

double stirling(double n) { return std::pow(n / std::numbers::e, n) * std::sqrt(2 * std::numbers::pi * n); }

struct Series {
  static constexpr ExperimentDescription kDescription{
      .name = "series",
      .label = "Series and lost digits",
      .summary =
          "A Taylor series that converges for every argument and whose sum loses all digits, and Stirling's formula",
      .source = "[Lang, eq. 6.3-6.7]"};

  Number<int> terms{
      "terms", "Largest number of terms", 400, {1, 2000}, "The sum ends earlier when further terms do not change it"};
  auto parameters() { return std::tie(terms); }

  Result<ExperimentResult> run(const RunContext& context) const {
    ExperimentResult result;
    result.table.columns = {"b", "terms", "largest term", "sum", "error"};
    metrics::FunctionChart chart{.title = "Error of the Taylor sum",
                                 .x_label = "terms",
                                 .y_label = "error",
                                 .curves = {},
                                 .logarithmic_x = false,
                                 .logarithmic_y = true};
    constexpr int kLargest = 7;
    for (int b = 1; b <= kLargest; ++b) {
      if (!context.proceed(static_cast<double>(b) / kLargest)) return interrupted();
      metrics::FunctionCurve curve{.name = "b = " + std::to_string(b), .points = {}};
      const double exact = gauss_integral(b);
      const auto sum = taylor_sum(b, terms - 1, [&](int n, double partial) {
        curve.points.push_back({static_cast<double>(n + 1), std::abs(partial - exact)});
      });
      chart.curves.push_back(std::move(curve));
      result.table.rows.push_back(
          {static_cast<double>(b), static_cast<double>(sum.terms), sum.largest, sum.sum, sum.sum - exact});
      if (sum.terms < terms) check_rounding(b, sum, exact, result);
    }
    check_short_sums(result);
    add_stirling(result);
    result.charts.insert(result.charts.begin(), std::move(chart));
    return result;
  }

 private:
  // Rounding errors of the terms add up to some units in the last place of the largest one, and not to much less.
  static void check_rounding(int b, const TaylorSum& sum, double exact, ExperimentResult& result) {
    const double unit = std::ldexp(sum.largest, -53);
    result.checks.push_back(
        {"error of the sum for b = " + std::to_string(b), sum.sum, exact, std::max(20 * unit, 1e-15)});
    constexpr double kLargestTerms[] = {5.8e8, 2.4e13, 7.8e18};
    if (b >= 5) {
      const double expected = kLargestTerms[b - 5];
      result.checks.push_back({"largest term for b = " + std::to_string(b), sum.largest, expected, 0.02 * expected});
    }
    if (std::abs(sum.sum - exact) > exact)
      result.notes.push_back("For b = " + std::to_string(b) +
                             " the error exceeds the integral: no digit of the sum is right.");
  }

  static void check_short_sums(ExperimentResult& result) {
    struct ShortSum {
      double b, error, tolerance;
    };
    for (const auto& [b, error, tolerance] :
         {ShortSum{1, -9.494e-5, 5e-9}, ShortSum{2, -0.5775, 5e-5}, ShortSum{3, -77.7, 0.05}}) {
      const auto sum = taylor_sum(b, 5, [](int, double) {});
      result.checks.push_back({"error of terms 0 to 5 for b = " + std::to_string(static_cast<int>(b)),
                               sum.sum - gauss_integral(b), error, tolerance});
    }
  }

  static void add_stirling(ExperimentResult& result) {
    metrics::FunctionCurve curve{.name = "Stirling's formula", .points = {}};
    metrics::FunctionCurve theory{.name = "1 / (12 n)", .points = {}};
    constexpr int kLargest = 100;
    for (int n = 1; n <= kLargest; ++n) {
      curve.points.push_back({static_cast<double>(n), 1 - stirling(n) / std::tgamma(n + 1.0)});
      theory.points.push_back({static_cast<double>(n), 1.0 / (12 * n)});
    }
    result.charts.push_back(metrics::FunctionChart{.title = "Relative error of Stirling's formula",
                                                   .x_label = "n",
                                                   .y_label = "1 - approximation / n!",
                                                   .curves = {curve, theory},
                                                   .logarithmic_x = true,
                                                   .logarithmic_y = true});
    struct Value {
      int n;
      double error;
    };
    for (const auto& [n, error] :
         {Value{1, 0.0778630}, Value{2, 0.0404978}, Value{5, 0.0165069}, Value{10, 0.00829596}, Value{20, 0.00415765}})
      result.checks.push_back(
          {"Stirling's formula for n = " + std::to_string(n), curve.points[static_cast<size_t>(n - 1)].y, error, 1e-7});
  }
};

}  // namespace

Experiment series_experiment() { return make_experiment<Series>(); }

}  // namespace etendue::experiments
