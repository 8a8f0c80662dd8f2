// Monte Carlo solution of an integral equation at one point, by paths [Lang, eq. 6.598-6.631]
//
//   f(x) = g(x) + integral of k(x, y) f(y) dy
//
// A path X_0 = x, X_1, X_2, ... has uniform vertices with density p and continues with probability alpha. Its weight is
// the product of k(X_(i-1), X_i) / (p alpha).
//
//   collision   adds weight times g at each vertex
//   absorption  adds weight times g / (1 - alpha) at the last vertex only [Forsythe and Leibler 1950]
//   next event  f = g + h: samples a point y of the source with the density q proportional to g at each vertex, and adds
//               weight times k g / q. Vertices of the path do not count g again
//
// The second moments of these estimators are solutions of integral equations with the kernel k^2 / (p alpha):
//
//   collision   S = g^2 + 2 g (f - g) + integral of k^2/(p alpha) S
//   absorption  S = g^2 / (1 - alpha) + integral of k^2/(p alpha) S
//   next event  S = integral of k^2 g^2 / q + 2 (integral of k g)(integral of k h) + integral of k^2/(p alpha) S
//
// which give the variances in the table. If the spectral radius of that kernel is 1 or more, the variance is infinite: for
// a constant kernel if alpha <= lambda^2. If the spectral radius of |k| is 1 or more, the mean does not exist, and the
// experiment refuses the equation.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "equations/random_numbers.h"
#include "experiments/equation_examples.h"
#include "experiments/error_curves.h"
#include "experiments/moments.h"

namespace etendue::experiments {
namespace {

using equations::FredholmEquation;
using equations::RandomNumbers;

// The source as a density: a point with a density proportional to g.
struct SourceSampler {
  double low, high;  // where g is constant and not zero
  double pdf() const { return 1 / (high - low); }
  double sample(RandomNumbers& random) const { return low + (high - low) * random.uniform(); }
};

SourceSampler source_sampler(EquationKind kind, const FredholmEquation& e) {
  if (kind == EquationKind::small_light) return {0.5 - kSmallLight, 0.5 + kSmallLight};
  return {e.a, e.b};
}

struct PathProblem {
  const FredholmEquation& equation;
  SourceSampler source;
  double x;      // the first vertex
  double alpha;  // probability of continuation
  double pdf() const { return 1 / equation.width(); }
};

double collision_estimate(const PathProblem& p, RandomNumbers& random) {
  double x = p.x, weight = 1, sum = p.equation.source(x);
  while (random.uniform() < p.alpha) {
    const double y = p.equation.a + p.equation.width() * random.uniform();
    weight *= p.equation.kernel(x, y) / (p.pdf() * p.alpha);
    x = y;
    sum += weight * p.equation.source(x);
  }
  return sum;
}

double absorption_estimate(const PathProblem& p, RandomNumbers& random) {
  double x = p.x, weight = 1;
  while (random.uniform() < p.alpha) {
    const double y = p.equation.a + p.equation.width() * random.uniform();
    weight *= p.equation.kernel(x, y) / (p.pdf() * p.alpha);
    x = y;
  }
  return weight * p.equation.source(x) / (1 - p.alpha);
}

double next_event_estimate(const PathProblem& p, RandomNumbers& random) {
  double x = p.x, weight = 1, sum = p.equation.source(x);
  for (;;) {
    const double light = p.source.sample(random);
    sum += weight * p.equation.kernel(x, light) * p.equation.source(light) / p.source.pdf();
    if (random.uniform() >= p.alpha) return sum;
    const double y = p.equation.a + p.equation.width() * random.uniform();
    weight *= p.equation.kernel(x, y) / (p.pdf() * p.alpha);
    x = y;
  }
}

// Integrals over the interval by Gauss rules in panels whose ends include those of the source.
class PathIntegrals {
 public:
  explicit PathIntegrals(const PathProblem& problem) : problem_(problem) {
    const FredholmEquation& e = problem.equation;
    const std::array<double, 4> ends{e.a, problem.source.low, problem.source.high, e.b};
    const auto gauss = equations::gauss_rule(8, 4);
    for (size_t part = 0; part + 1 < ends.size(); ++part)
      for (size_t i = 0; i < gauss.size(); ++i) {
        const double width = ends[part + 1] - ends[part];
        if (width <= 0) continue;
        // In units of the interval, as quadrature rules of equations are.
        rule_.nodes.push_back((ends[part] + width * gauss.nodes[i] - e.a) / e.width());
        rule_.weights.push_back(width * gauss.weights[i] / e.width());
      }
  }

  double integral(const std::function<double(double)>& f) const {
    const FredholmEquation& e = problem_.equation;
    double sum = 0;
    for (size_t i = 0; i < rule_.size(); ++i) sum += e.width() * rule_.weights[i] * f(e.a + e.width() * rule_.nodes[i]);
    return sum;
  }

  // The solution at x of an equation with the kernel k^2 / (p alpha).
  Result<double> second_moment(std::function<double(double)> source) const {
    const auto solution = equations::solve_nystrom({.a = problem_.equation.a,
                                                    .b = problem_.equation.b,
                                                    .kernel = squared_kernel(),
                                                    .source = std::move(source),
                                                    .solution = {}},
                                                   rule_);
    if (!solution) return solution.error();
    return solution->extension(problem_.x);
  }

  std::function<double(double, double)> squared_kernel() const {
    return [k = problem_.equation.kernel, factor = 1 / (problem_.pdf() * problem_.alpha)](double x, double y) {
      return k(x, y) * k(x, y) * factor;
    };
  }

 private:
  PathProblem problem_;
  equations::QuadratureRule rule_;
};

Result<double> collision_moment(const PathProblem& p, const PathIntegrals& integrals) {
  const FredholmEquation& e = p.equation;
  return integrals.second_moment([&e](double x) { return e.source(x) * (2 * e.solution(x) - e.source(x)); });
}

Result<double> absorption_moment(const PathProblem& p, const PathIntegrals& integrals) {
  return integrals.second_moment([&p](double x) { return std::pow(p.equation.source(x), 2) / (1 - p.alpha); });
}

// The second moment of the estimate without g(x), which has no variance.
Result<double> next_event_moment(const PathProblem& p, const PathIntegrals& integrals) {
  const FredholmEquation& e = p.equation;
  return integrals.second_moment([&](double x) {
    const double light = integrals.integral([&](double y) { return e.kernel(x, y) * e.source(y); });
    const double squares = integrals.integral(
        [&](double y) { return e.source(y) == 0 ? 0 : std::pow(e.kernel(x, y) * e.source(y), 2) / p.source.pdf(); });
    const double rest = e.solution(x) - e.source(x) - light;
    return squares + 2 * light * rest;
  });
}

struct PathEstimator {
  const char* name;
  double (*estimate)(const PathProblem&, RandomNumbers&);
  Result<double> (*second_moment)(const PathProblem&, const PathIntegrals&);
  bool without_source;  // whether the moment is that of the estimate minus g(x)
};
constexpr PathEstimator kPathEstimators[] = {{"collision", collision_estimate, collision_moment, false},
                                             {"absorption", absorption_estimate, absorption_moment, false},
                                             {"next event", next_event_estimate, next_event_moment, true}};

struct RandomWalks {
  static constexpr ExperimentDescription kDescription{
      .name = "random-walks",
      .label = "Integral equations by random paths",
      .summary = "Collision, absorption and next event estimators: error over paths, and variance against theory",
      .source = "[Lang, eq. 6.598-6.631; Forsythe and Leibler 1950]"};

  Choice<EquationKind> equation = equation_parameter(EquationKind::small_light);
  Number<float> lambda = lambda_parameter();
  Number<float> alpha{"alpha",
                      "Continuation",
                      0.6f,
                      {0.01f, 0.99f},
                      "Probability that a path continues. Higher gives longer paths with less variance"};
  Number<float> position{"position", "Position", 0.2f, {0, 1}, "Where f is estimated, as a share of the interval"};
  Number<int> paths{"paths", "Paths", 8192, {64, 1048576}, "Number of paths of an estimate", "", Scale::logarithmic};
  auto parameters() { return std::tie(equation, lambda, alpha, position, paths); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const FredholmEquation e = make_equation(equation, static_cast<double>(lambda));
    if (auto refused = why_without_mean(e); !refused.empty()) return input_error(std::move(refused));
    const PathProblem problem{.equation = e,
                              .source = source_sampler(equation, e),
                              .x = e.a + e.width() * static_cast<double>(position),
                              .alpha = static_cast<double>(alpha)};
    const PathIntegrals integrals(problem);
    const double variance_radius = equations::spectral_radius(e, integrals.squared_kernel());
    ExperimentResult result;
    if (variance_radius >= 1)
      result.notes.push_back("The variance is infinite: the spectral radius of k\u00b2/(p \u03b1) is " +
                             metrics::short_number(variance_radius) + ". Raise alpha.");
    result.table.columns = {"estimator", "mean", "N Var, measured", "N Var, theory", "slope of the error"};
    ErrorChart chart{.title = "Error of the solution at one point", .work = "paths", .curves = {}};
    for (const PathEstimator& estimator : kPathEstimators) {
      auto curves = error_curves_of(estimator, problem, context);
      if (!curves) return curves.error();
      if (const auto ok =
              add_numbers(estimator, problem, integrals, variance_radius < 1, *curves, context.seed, result);
          !ok)
        return ok.error();
      chart.curves.push_back(std::move(*curves));
    }
    result.charts = {std::move(chart)};
    return result;
  }

 private:
  static std::string why_without_mean(const FredholmEquation& e) {
    const double radius = equations::spectral_radius(e, [&e](double x, double y) { return std::abs(e.kernel(x, y)); });
    if (radius < 1) return "";
    return "the Neumann series diverges: the spectral radius of the kernel is " + metrics::short_number(radius) +
           ", so that the estimates of paths have no mean; use the experiment fredholm, or a smaller lambda";
  }

  Result<metrics::MethodCurves> error_curves_of(const PathEstimator& estimator, const PathProblem& problem,
                                                const RunContext& context) const {
    const auto work = powers_of_two(2, static_cast<int>(std::log2(paths.value)));
    const double exact = problem.equation.solution(problem.x);
    const auto errors = [&](int repeat, std::span<double> out) {
      RandomNumbers random = numbers_for(estimator, context.seed, repeat + 1);
      double sum = 0;
      size_t k = 0;
      for (int i = 1; k < work.size(); ++i) {
        sum += estimator.estimate(problem, random);
        if (i == static_cast<int>(work[k])) out[k++] = sum / i - exact;
      }
    };
    return rms_error_curves(estimator.name, work, {}, errors, context);
  }

  static RandomNumbers numbers_for(const PathEstimator& estimator, uint64_t seed, int repeat) {
    return RandomNumbers(mix_bits(seed) + static_cast<uint64_t>(repeat) * std::size(kPathEstimators) +
                         static_cast<uint64_t>(&estimator - kPathEstimators));
  }

  Result<void> add_numbers(const PathEstimator& estimator, const PathProblem& problem, const PathIntegrals& integrals,
                           bool has_variance, const metrics::MethodCurves& curves, uint64_t seed,
                           ExperimentResult& result) const {
    Moments moments;
    RandomNumbers random = numbers_for(estimator, seed, 0);
    for (int i = 0; i < paths; ++i) moments.add(estimator.estimate(problem, random));
    const auto s = slope(curves);
    const std::string name = estimator.name;
    const double exact = problem.equation.solution(problem.x);
    Table::Cell theory = "infinite";
    if (has_variance) {
      const auto second = estimator.second_moment(problem, integrals);
      if (!second) return second.error();
      const double mean = exact - (estimator.without_source ? problem.equation.source(problem.x) : 0);
      const double variance = std::max(0.0, *second - mean * mean);
      theory = variance;
      result.checks.push_back(
          {name + ": N Var", moments.variance(), variance, kStandardErrors * moments.variance_error() + 1e-9});
      result.checks.push_back({name + ": mean", moments.mean(), exact, kStandardErrors * moments.mean_error() + 1e-9});
    }
    result.table.rows.push_back({name, moments.mean(), moments.variance(), theory, s.known ? s.value : NAN});
    return {};
  }
};

}  // namespace

Experiment random_walks_experiment() { return make_experiment<RandomWalks>(); }

}  // namespace etendue::experiments
