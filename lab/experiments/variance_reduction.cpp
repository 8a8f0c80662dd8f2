// Variance reduction in one and two dimensions: each technique with an integrand where it helps and one where it hurts
// [Lang, sec. 6.5]
//
// The efficiency of an estimator is 1 / (variance x cost) [Lang, eq. 6.373]. The cost is the number of evaluations of the
// integrand for one estimate. The table has variance x cost of the plain estimator and of the technique, and their ratio:
// above 1 the technique helps. All values have closed forms.
//
//   importance   f(X) / p(X) with X of density p
//   control      f(U) - g(U) plus the integral of g
//   antithetic   the mean of f(U) and f(1 - U)
//   stratified   one sample in each of 16 intervals, or two intervals of unequal width with as many samples each
//   neyman       samples in proportion to width times standard deviation of each interval [Lang, eq. 6.491], or of the
//                wrong interval
//   expected     one of two variables is integrated; helps always, unless the integral costs more than it saves
//   splitting    four values of the second variable for each value of the first one
//   roulette     evaluates an expensive term with probability 1/2 and doubles it
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "equations/random_numbers.h"
#include "experiments/error_curves.h"
#include "experiments/moments.h"

namespace etendue::experiments {

enum class Technique { importance, control, antithetic, stratified, neyman, expected, splitting, roulette };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::Technique> {
  static constexpr std::array<etendue::Option, 8> kOptions{{{"importance", "Importance sampling"},
                                                            {"control", "Control variates"},
                                                            {"antithetic", "Antithetic variates"},
                                                            {"stratified", "Stratified sampling"},
                                                            {"neyman", "Neyman allocation"},
                                                            {"expected", "Expected values"},
                                                            {"splitting", "Splitting"},
                                                            {"roulette", "Russian roulette"}}};
};

namespace etendue::experiments {
namespace {

using equations::RandomNumbers;
using std::numbers::e;

double square(double x) { return x * x; }

// One estimate, and its exact variance and cost.
struct ReducedEstimator {
  double (*estimate)(RandomNumbers&);
  double variance, cost;
  double work() const { return variance * cost; }
};

// The plain estimator and a technique for the same integral.
struct Comparison {
  Technique technique;
  const char* integrand;  // and what the technique uses
  double integral;
  ReducedEstimator plain, reduced;
};

double exponential_sample(RandomNumbers& u) { return std::exp(u.uniform()); }
double square_sample(RandomNumbers& u) { return square(u.uniform()); }

// x with the density 2 (1 + x) / 3
double rising_position(RandomNumbers& u) { return std::sqrt(1 + 3 * u.uniform()) - 1; }

double in_interval(RandomNumbers& u, double low, double high) { return low + (high - low) * u.uniform(); }

// The integral of x^2 from `count` samples of [0, 1/2] and `others` of [1/2, 1].
double two_intervals(RandomNumbers& u, int count, int others) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += 0.5 * square(in_interval(u, 0, 0.5)) / count;
  for (int i = 0; i < others; ++i) sum += 0.5 * square(in_interval(u, 0.5, 1)) / others;
  return sum;
}

// Variances of x^2 in [0, 1/2] and [1/2, 1].
constexpr double kLowVariance = 1.0 / 180, kHighVariance = 17.0 / 360;
constexpr double two_interval_variance(int count, int others) {
  return 0.25 * (kLowVariance / count + kHighVariance / others);
}

// The factor of x that removes most variance of exp x: their covariance over the variance of x.
constexpr double kBestFactor = 12 * (1 - (e - 1) / 2);

// The reflected radiance in uniform light of the lobe (n + 2) / (2 pi) cos^n, n = 10, from a direction with this cosine and
// the density cos^(k - 1) k / (2 pi).
double lobe_sample(double cosine, int k) { return 12 * std::pow(cosine, 12 - k) / k; }

// The mean of `inner` values of a x + b y for one x.
template <int inner>
double split_sum(RandomNumbers& u, double a, double b) {
  const double x = u.uniform();
  double sum = 0;
  for (int i = 0; i < inner; ++i) sum += a * x + b * u.uniform();
  return sum / inner;
}

// a x + b y, where b y is evaluated with probability 1/2.
double roulette_sum(RandomNumbers& u, double a, double b) {
  const double sum = a * u.uniform();
  return u.uniform() < 0.5 ? sum + 2 * b * u.uniform() : sum;
}

// Costs in evaluations: of x with splitting, of the second term of the roulette, of the integral over y.
constexpr double kOuterCost = 1, kExpensiveCost = 10, kInnerIntegralCost = 4;
constexpr double linear_variance(double a, double b) { return (a * a + b * b) / 12; }
constexpr double split_variance(double a, double b, int inner) { return a * a / 12 + b * b / (12 * inner); }
constexpr double roulette_variance(double a, double b) { return a * a / 12 + b * b * (2.0 / 3 - 0.25); }

const std::vector<Comparison>& comparisons() {
  static const std::vector<Comparison> all{
      {Technique::importance,
       "x\u00b2, p = 2x",
       1.0 / 3,
       {square_sample, 4.0 / 45, 1},
       {[](RandomNumbers& u) { return std::sqrt(1 - u.uniform()) / 2; }, 1.0 / 72, 1}},
      {Technique::importance,
       "1 - x, p = 2 (1 + x) / 3",
       0.5,
       {[](RandomNumbers& u) { return u.uniform(); }, 1.0 / 12, 1},
       {[](RandomNumbers& u) {
          const double x = rising_position(u);
          return 1.5 * (1 - x) / (1 + x);
        },
        1.5 * (4 * std::numbers::ln2 - 2.5) - 0.25, 1}},
      {Technique::importance,
       "exp(-x), p = 4/3 - 2x/3",
       1 - 1 / e,
       {[](RandomNumbers& u) { return std::exp(-u.uniform()); }, 0.0327559575, 1},
       {[](RandomNumbers& u) {
          const double x = 2 - std::sqrt(4 - 3 * u.uniform());
          return std::exp(-x) / (4.0 / 3 - 2 * x / 3);
        },
        0.0036416597, 1}},
      {Technique::importance,
       "lobe 6/\u03c0 cos\u00b9\u2070 of the hemisphere, p = cos/\u03c0",
       1,
       {[](RandomNumbers& u) { return lobe_sample(u.uniform(), 1); }, 144.0 / 23 - 1, 1},
       {[](RandomNumbers& u) { return lobe_sample(std::sqrt(u.uniform()), 2); }, 144.0 / 44 - 1, 1}},
      {Technique::control,
       "exp x, g = 1 + x",
       e - 1,
       {exponential_sample, (e - 1) * (3 - e) / 2, 1},
       {[](RandomNumbers& u) {
          const double x = u.uniform();
          return std::exp(x) - 1 - x + 1.5;
        },
        0.0436507692, 1}},
      {Technique::control,
       "exp x, g = \u03b2 (1 + x) with the best \u03b2",
       e - 1,
       {exponential_sample, (e - 1) * (3 - e) / 2, 1},
       {[](RandomNumbers& u) {
          const double x = u.uniform();
          return std::exp(x) - kBestFactor * (x - 0.5);
        },
        (e - 1) * (3 - e) / 2 - kBestFactor * kBestFactor / 12, 1}},
      {Technique::control,
       "x (1 - x), g = x",
       1.0 / 6,
       {[](RandomNumbers& u) {
          const double x = u.uniform();
          return x * (1 - x);
        },
        1.0 / 180, 1},
       {[](RandomNumbers& u) { return 0.5 - square(u.uniform()); }, 4.0 / 45, 1}},
      {Technique::antithetic,
       "exp x",
       e - 1,
       {exponential_sample, (e - 1) * (3 - e) / 2, 1},
       {[](RandomNumbers& u) {
          const double x = u.uniform();
          return (std::exp(x) + std::exp(1 - x)) / 2;
        },
        ((e - 1) * (3 - e) / 2 + e - square(e - 1)) / 2, 2}},
      {Technique::antithetic,
       "(x - 1/2)\u00b2, symmetric",
       1.0 / 12,
       {[](RandomNumbers& u) { return square(u.uniform() - 0.5); }, 1.0 / 180, 1},
       {[](RandomNumbers& u) { return square(u.uniform() - 0.5); }, 1.0 / 180, 2}},
      {Technique::stratified,
       "x\u00b2, 16 intervals",
       1.0 / 3,
       {square_sample, 4.0 / 45, 1},
       {[](RandomNumbers& u) {
          double sum = 0;
          for (int i = 0; i < 16; ++i) sum += square((i + u.uniform()) / 16) / 16;
          return sum;
        },
        1 / (9 * 4096.0) - 1 / (45 * 1048576.0), 16}},
      {Technique::stratified,
       "x, intervals of width 0.9 and 0.1",
       0.5,
       {[](RandomNumbers& u) { return u.uniform(); }, 1.0 / 12, 1},
       {[](RandomNumbers& u) {
          const double low = in_interval(u, 0, 0.9);
          return 0.9 * low + 0.1 * in_interval(u, 0.9, 1);
        },
        (0.9 * 0.9 * 0.9 * 0.9 + 1e-4) / 12, 2}},
      {Technique::neyman,
       "x\u00b2, 1 and 3 samples, against 2 and 2",
       1.0 / 3,
       {[](RandomNumbers& u) { return two_intervals(u, 2, 2); }, two_interval_variance(2, 2), 4},
       {[](RandomNumbers& u) { return two_intervals(u, 1, 3); }, two_interval_variance(1, 3), 4}},
      {Technique::neyman,
       "x\u00b2, 3 and 1 samples, against 2 and 2",
       1.0 / 3,
       {[](RandomNumbers& u) { return two_intervals(u, 2, 2); }, two_interval_variance(2, 2), 4},
       {[](RandomNumbers& u) { return two_intervals(u, 3, 1); }, two_interval_variance(3, 1), 4}},
      {Technique::expected,
       "x y, y integrated",
       0.25,
       {[](RandomNumbers& u) {
          const double x = u.uniform();
          return x * u.uniform();
        },
        7.0 / 144, 1},
       {[](RandomNumbers& u) { return u.uniform() / 2; }, 1.0 / 48, 1}},
      {Technique::expected,
       "x + y/10, y integrated for the cost of 4 values",
       0.55,
       {[](RandomNumbers& u) { return split_sum<1>(u, 1, 0.1); }, linear_variance(1, 0.1), 1},
       {[](RandomNumbers& u) { return u.uniform() + 0.05; }, 1.0 / 12, kInnerIntegralCost}},
      {Technique::splitting,
       "x/10 + y, four y for each x",
       0.55,
       {[](RandomNumbers& u) { return split_sum<1>(u, 0.1, 1); }, linear_variance(0.1, 1), kOuterCost + 1},
       {[](RandomNumbers& u) { return split_sum<4>(u, 0.1, 1); }, split_variance(0.1, 1, 4), kOuterCost + 4}},
      {Technique::splitting,
       "x + y/10, four y for each x",
       0.55,
       {[](RandomNumbers& u) { return split_sum<1>(u, 1, 0.1); }, linear_variance(1, 0.1), kOuterCost + 1},
       {[](RandomNumbers& u) { return split_sum<4>(u, 1, 0.1); }, split_variance(1, 0.1, 4), kOuterCost + 4}},
      {Technique::roulette,
       "x + y/10, y is expensive",
       0.55,
       {[](RandomNumbers& u) { return split_sum<1>(u, 1, 0.1); }, linear_variance(1, 0.1), 1 + kExpensiveCost},
       {[](RandomNumbers& u) { return roulette_sum(u, 1, 0.1); }, roulette_variance(1, 0.1), 1 + kExpensiveCost / 2}},
      {Technique::roulette,
       "x/10 + y, y is expensive",
       0.55,
       {[](RandomNumbers& u) { return split_sum<1>(u, 0.1, 1); }, linear_variance(0.1, 1), 1 + kExpensiveCost},
       {[](RandomNumbers& u) { return roulette_sum(u, 0.1, 1); }, roulette_variance(0.1, 1), 1 + kExpensiveCost / 2}}};
  return all;
}

struct VarianceReduction {
  static constexpr ExperimentDescription kDescription{
      .name = "variance-reduction",
      .label = "Variance reduction",
      .summary =
          "Variance times cost of eight techniques, each with an integrand where it helps and one where it hurts",
      .source = "[Lang, sec. 6.5, eq. 6.373, 6.390, 6.403, 6.454, 6.485-6.522]"};

  Choice<Technique> technique{"technique", "Technique", Technique::importance, "The technique on the chart"};
  Number<int> samples{
      "samples", "Samples",         16384, {256, 1048576}, "Number of estimates from which variances are computed",
      "",        Scale::logarithmic};
  auto parameters() { return std::tie(technique, samples); }

  Result<ExperimentResult> run(const RunContext& context) const {
    ExperimentResult result;
    result.table.columns = {"technique", "integrand", "plain: variance x cost", "reduced: variance x cost",
                            "ratio",     "result"};
    ErrorChart chart{.title = "Error over evaluations", .work = "evaluations", .curves = {}};
    uint64_t stream = mix_bits(context.seed);
    for (const Comparison& c : comparisons()) {
      const std::string name = Options<Technique>::kOptions[static_cast<size_t>(c.technique)].name;
      const std::string title = name + ", " + c.integrand;
      add_checks(title, c.integral, c.reduced, ++stream, result);
      const double ratio = c.plain.work() / c.reduced.work();
      result.table.rows.push_back({name, std::string(c.integrand), c.plain.work(), c.reduced.work(), ratio,
                                   std::string(ratio > 1 ? "helps" : "hurts")});
      if (c.technique != technique) continue;
      for (const auto* estimator : {&c.plain, &c.reduced}) {
        auto curves = curves_of((estimator == &c.plain ? "plain: " : "reduced: ") + std::string(c.integrand),
                                c.integral, *estimator, ++stream, context);
        if (!curves) return curves.error();
        chart.curves.push_back(std::move(*curves));
      }
    }
    result.charts = {std::move(chart)};
    return result;
  }

 private:
  void add_checks(const std::string& title, double integral, const ReducedEstimator& estimator, uint64_t seed,
                  ExperimentResult& result) const {
    RandomNumbers random(seed);
    Moments moments;
    for (int i = 0; i < samples; ++i) moments.add(estimator.estimate(random));
    result.checks.push_back(
        {title + ": variance", moments.variance(), estimator.variance, kStandardErrors * moments.variance_error()});
    result.checks.push_back({title + ": mean", moments.mean(), integral, kStandardErrors * moments.mean_error()});
  }

  Result<metrics::MethodCurves> curves_of(const std::string& name, double integral, const ReducedEstimator& estimator,
                                          uint64_t seed, const RunContext& context) const {
    const auto counts = powers_of_two(0, 10);
    std::vector<double> work;
    for (const double n : counts) work.push_back(n * estimator.cost);
    const auto errors = [&](int repeat, std::span<double> out) {
      RandomNumbers random(mix_bits(seed) + static_cast<uint64_t>(repeat));
      double sum = 0;
      size_t k = 0;
      for (int i = 1; k < counts.size(); ++i) {
        sum += estimator.estimate(random);
        if (i == static_cast<int>(counts[k])) out[k++] = sum / i - integral;
      }
    };
    return rms_error_curves(name, work, {.groups = 8, .per_group = 64}, errors, context);
  }
};

}  // namespace

Experiment variance_reduction_experiment() { return make_experiment<VarianceReduction>(); }

}  // namespace etendue::experiments
