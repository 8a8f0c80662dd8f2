// Seven weights for two densities [Lang, eq. 6.546-6.572; Veach and Guibas 1995; Kondapaneni et al. 2019]
//
//   F = sum over i of (1/n_i) sum over j of w_i(X_ij) f(X_ij) / p_i(X_ij),   X_ij of density p_i
//
//   constant   w_i = 1/2
//   balance    w_i = n_i p_i / sum of n_k p_k
//   cutoff     0 where n_i p_i is less than `cutoff` times the largest one, balance among the others
//   power      w_i = (n_i p_i)^beta / sum of (n_k p_k)^beta
//   maximum    1 for the largest n_i p_i
//   partition  1 for the second density in a part of the domain, and for the first one elsewhere
//   optimal    w_i = alpha_i p_i / f + n_i p_i / (sum of n_k p_k) (1 - sum of alpha_k p_k / f), which may be negative. The
//              alphas solve A alpha = b with a_ij = integral of p_i p_j / sum of n_k p_k, b_i = integral of
//              f p_i / sum of n_k p_k. They need these integrals, which a renderer would have to estimate.
//
// The variances in the table are integrals, computed by quadrature, for one sample of each density. Balance is cutoff with
// 0 and power with 1; maximum is cutoff with 1 [Lang, Remark 6.31].
//
// Problems:
//
//   linear   f = x on [0, 1], p_1 = 1, p_2 = 2x: the second density has no variance, so that every weight that uses the
//            first one hurts, except for the optimal one
//   square   f = x^2 with the same densities
//   glossy   a highlight: p_1 is a normal distribution of deviation `sigma` around 1/2, the lobe; p_2 is uniform in a
//            light of half width `width`, with radiance 1 / (2 width); f = p_1 times the radiance. No single density is
//            good for all lobes and lights
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "equations/quadrature.h"
#include "equations/random_numbers.h"
#include "experiments/error_curves.h"
#include "experiments/moments.h"

namespace etendue::experiments {

enum class CombinedProblem { linear, square, glossy };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::CombinedProblem> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"linear", "x, densities 1 and 2x"}, {"square", "x\u00b2, densities 1 and 2x"}, {"glossy", "Glossy highlight"}}};
};

namespace etendue::experiments {
namespace {

using equations::RandomNumbers;
using Pair = std::array<double, 2>;

constexpr double kNormalExtent = 8;  // of the lobe, in deviations

// An integrand and two densities with one sample each.
struct TwoDensities {
  std::function<double(double)> f;
  std::array<std::function<double(double)>, 2> pdf;
  std::array<std::function<double(RandomNumbers&)>, 2> sample;
  std::function<bool(double)> second_part;  // where the partition uses the second density
  std::vector<double> ends;  // of intervals in which all functions are smooth and the ratio of densities is monotone
  double integral;
};

TwoDensities polynomial_problem(int power) {
  return {
      .f = [power](double x) { return std::pow(x, power); },
      .pdf = {[](double) { return 1.0; }, [](double x) { return 2 * x; }},
      .sample = {[](RandomNumbers& u) { return u.uniform(); }, [](RandomNumbers& u) { return std::sqrt(u.uniform()); }},
      .second_part = [](double x) { return x > 0.5; },
      .ends = {0, 0.5, 1},
      .integral = 1.0 / (power + 1)};
}

TwoDensities glossy_problem(double sigma, double width) {
  const auto lobe = [sigma](double x) {
    const double t = (x - 0.5) / sigma;
    return std::exp(-t * t / 2) / (sigma * std::sqrt(2 * std::numbers::pi));
  };
  const auto in_light = [width](double x) { return std::abs(x - 0.5) < width; };
  const auto normal = [sigma](RandomNumbers& u) {
    // Box and Muller's transformation.
    const double radius = std::sqrt(-2 * std::log(1 - u.uniform()));
    return 0.5 + sigma * radius * std::cos(2 * std::numbers::pi * u.uniform());
  };
  std::vector<double> ends;
  for (const double x : {-kNormalExtent * sigma, -width, -width / 2, 0.0, width / 2, width, kNormalExtent * sigma})
    ends.push_back(0.5 + x);
  std::ranges::sort(ends);
  return {.f = [=](double x) { return in_light(x) ? lobe(x) / (2 * width) : 0; },
          .pdf = {lobe, [=](double x) { return in_light(x) ? 0.5 / width : 0; }},
          .sample = {normal, [=](RandomNumbers& u) { return 0.5 + width * (2 * u.uniform() - 1); }},
          .second_part = [=](double x) { return std::abs(x - 0.5) < width / 2; },
          .ends = ends,
          .integral = std::erf(width / (sigma * std::numbers::sqrt2)) / (2 * width)};
}

// Adds the points where the ratio of the densities is `level`, so that weights with thresholds jump at the ends of
// intervals only.
void divide_at_ratio(TwoDensities& problem, double level) {
  const auto above = [&](double x) { return problem.pdf[0](x) > level * problem.pdf[1](x); };
  std::vector<double> crossings;
  for (size_t part = 0; part + 1 < problem.ends.size(); ++part) {
    const double margin = 1e-9 * (problem.ends[part + 1] - problem.ends[part]);
    double low = problem.ends[part] + margin, high = problem.ends[part + 1] - margin;
    const bool at_low = above(low);
    if (high <= low || at_low == above(high)) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (above(middle) == at_low ? low : high) = middle;
    }
    crossings.push_back(low);
  }
  problem.ends.insert(problem.ends.end(), crossings.begin(), crossings.end());
  std::ranges::sort(problem.ends);
}

double integral_over(const TwoDensities& problem, const std::function<double(double)>& f) {
  static const auto rule = equations::gauss_rule(8, 64);
  double sum = 0;
  for (size_t part = 0; part + 1 < problem.ends.size(); ++part) {
    const double low = problem.ends[part], width = problem.ends[part + 1] - low;
    if (width <= 0) continue;
    for (size_t i = 0; i < rule.size(); ++i) sum += width * rule.weights[i] * f(low + width * rule.nodes[i]);
  }
  return sum;
}

// The contribution w_i f / p_i of a sample x of density i.
struct Heuristic {
  std::string name;
  std::function<double(size_t i, double x)> contribution;
};

// From weights that sum to 1, as functions of the two densities.
Heuristic weighted(const std::string& name, const TwoDensities& problem, std::function<Pair(Pair p)> weights) {
  return {name, [&problem, weights = std::move(weights)](size_t i, double x) {
            const Pair p{problem.pdf[0](x), problem.pdf[1](x)};
            return p[i] > 0 ? weights(p)[i] * problem.f(x) / p[i] : 0;
          }};
}

Pair cutoff_weights(Pair p, double cutoff) {
  const double threshold = cutoff * std::max(p[0], p[1]);
  for (double& value : p)
    if (value < threshold) value = 0;
  const double sum = p[0] + p[1];
  return sum > 0 ? Pair{p[0] / sum, p[1] / sum} : Pair{0, 0};
}

// With the ratios of the densities, whose powers cannot overflow.
Pair power_weights(Pair p, double beta) {
  const double largest = std::max(p[0], p[1]);
  if (largest <= 0) return {0, 0};
  const double a = std::pow(p[0] / largest, beta), b = std::pow(p[1] / largest, beta);
  return {a / (a + b), b / (a + b)};
}

// Equal densities belong to the first one [Lang, eq. 6.572, corrected].
Pair maximum_weights(Pair p) { return p[0] >= p[1] ? Pair{1, 0} : Pair{0, 1}; }

Heuristic optimal_heuristic(const TwoDensities& problem) {
  const auto sum_at = [&problem](double x) { return problem.pdf[0](x) + problem.pdf[1](x); };
  std::array<Pair, 2> a{};
  Pair b{};
  for (size_t i = 0; i < 2; ++i) {
    const auto& p = problem.pdf[i];
    b[i] = integral_over(problem, [&](double x) { return sum_at(x) > 0 ? problem.f(x) * p(x) / sum_at(x) : 0; });
    for (size_t j = 0; j < 2; ++j)
      a[i][j] =
          integral_over(problem, [&](double x) { return sum_at(x) > 0 ? p(x) * problem.pdf[j](x) / sum_at(x) : 0; });
  }
  const double determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  const Pair alpha{(b[0] * a[1][1] - b[1] * a[0][1]) / determinant, (b[1] * a[0][0] - b[0] * a[1][0]) / determinant};
  return {"optimal", [&problem, sum_at, alpha](size_t i, double x) {
            const double combined = alpha[0] * problem.pdf[0](x) + alpha[1] * problem.pdf[1](x);
            return alpha[i] + (problem.f(x) - combined) / sum_at(x);
          }};
}

// The variance of the sum of one contribution of each density.
double variance_of(const TwoDensities& problem, const Heuristic& heuristic) {
  double variance = 0;
  for (size_t i = 0; i < 2; ++i) {
    const auto moment = [&](int power) {
      return integral_over(problem, [&](double x) {
        const double p = problem.pdf[i](x);
        return p > 0 ? p * std::pow(heuristic.contribution(i, x), power) : 0;
      });
    };
    const double mean = moment(1);
    variance += moment(2) - mean * mean;
  }
  return std::max(0.0, variance);
}

struct Mis {
  static constexpr ExperimentDescription kDescription{
      .name = "mis",
      .label = "Multiple importance sampling",
      .summary = "Variances of seven ways to weight the samples of two densities",
      .source = "[Lang, eq. 6.546-6.572; Veach and Guibas 1995; Kondapaneni et al. 2019]"};

  Choice<CombinedProblem> problem{"problem", "Problem", CombinedProblem::glossy, "Integrand and densities"};
  Number<float> sigma{"sigma", "Lobe deviation", 0.05f, {0.001f, 0.5f}, "Standard deviation of the lobe of `glossy`"};
  Number<float> width{"width", "Light half width", 0.05f, {0.001f, 0.5f}, "Half of the width of the light of `glossy`"};
  Number<float> cutoff{
      "cutoff", "Cutoff", 0.5f, {0, 1}, "Density relative to the largest one below which a sample has no weight"};
  Number<float> power{"power", "Power", 2, {0.25f, 16}, "Exponent of the power heuristic"};
  Number<int> samples{"samples", "Samples",         4096, {64, 1048576}, "Number of samples of each density",
                      "",        Scale::logarithmic};
  auto parameters() { return std::tie(problem, sigma, width, cutoff, power, samples); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const TwoDensities p = make_problem();
    ExperimentResult result;
    result.table.columns = {"weights", "variance, measured", "variance, quadrature", "mean"};
    ErrorChart chart{.title = "Error over pairs of samples", .work = "pairs of samples", .curves = {}};
    uint64_t stream = mix_bits(context.seed);
    for (const Heuristic& h : heuristics(p)) {
      auto curves = curves_of(h, p, ++stream, context);
      if (!curves) return curves.error();
      chart.curves.push_back(std::move(*curves));
      add_numbers(h, p, ++stream, result);
    }
    add_identities(p, result);
    result.charts = {std::move(chart), weight_chart(p)};
    return result;
  }

 private:
  TwoDensities make_problem() const {
    TwoDensities p = problem == CombinedProblem::linear ? polynomial_problem(1)
                     : problem == CombinedProblem::square
                         ? polynomial_problem(2)
                         : glossy_problem(static_cast<double>(sigma), static_cast<double>(width));
    divide_at_ratio(p, 1);
    if (cutoff > 0 && cutoff < 1)
      for (const double level : {static_cast<double>(cutoff), 1 / static_cast<double>(cutoff)})
        divide_at_ratio(p, level);
    return p;
  }

  std::vector<Heuristic> heuristics(const TwoDensities& p) const {
    const double alpha = static_cast<double>(cutoff), beta = static_cast<double>(power);
    return {constant_heuristic(p),
            weighted("balance", p, [](Pair q) { return power_weights(q, 1); }),
            weighted("cutoff", p, [alpha](Pair q) { return cutoff_weights(q, alpha); }),
            weighted("power", p, [beta](Pair q) { return power_weights(q, beta); }),
            weighted("maximum", p, maximum_weights),
            partition_heuristic(p),
            optimal_heuristic(p)};
  }

  // Outside of the light f is zero, so that 1/2 is valid although the second density is zero there.
  static Heuristic constant_heuristic(const TwoDensities& p) {
    return weighted("constant", p, [](Pair) { return Pair{0.5, 0.5}; });
  }

  static Heuristic partition_heuristic(const TwoDensities& p) {
    return {"partition", [&p](size_t i, double x) {
              const double density = p.pdf[i](x);
              return p.second_part(x) == (i == 1) && density > 0 ? p.f(x) / density : 0;
            }};
  }

  Result<metrics::MethodCurves> curves_of(const Heuristic& h, const TwoDensities& p, uint64_t seed,
                                          const RunContext& context) const {
    const auto work = powers_of_two(0, static_cast<int>(std::log2(samples.value)));
    const auto errors = [&](int repeat, std::span<double> out) {
      RandomNumbers random(mix_bits(seed) + static_cast<uint64_t>(repeat));
      double sum = 0;
      size_t k = 0;
      for (int i = 1; k < work.size(); ++i) {
        sum += one_pair(h, p, random);
        if (i == static_cast<int>(work[k])) out[k++] = sum / i - p.integral;
      }
    };
    return rms_error_curves(h.name, work, {}, errors, context);
  }

  static double one_pair(const Heuristic& h, const TwoDensities& p, RandomNumbers& random) {
    double sum = 0;
    for (size_t i = 0; i < 2; ++i) sum += h.contribution(i, p.sample[i](random));
    return sum;
  }

  void add_numbers(const Heuristic& h, const TwoDensities& p, uint64_t seed, ExperimentResult& result) const {
    Moments moments;
    RandomNumbers random(seed);
    for (int i = 0; i < samples; ++i) moments.add(one_pair(h, p, random));
    const double variance = variance_of(p, h);
    const double rounding = 1e-12 * p.integral * p.integral;
    result.table.rows.push_back({h.name, moments.variance(), variance, moments.mean()});
    result.checks.push_back(
        {h.name + ": variance", moments.variance(), variance, kStandardErrors * moments.variance_error() + rounding});
    result.checks.push_back(
        {h.name + ": mean", moments.mean(), p.integral, kStandardErrors * moments.mean_error() + 1e-6 * p.integral});
  }

  // Balance is cutoff with 0 and power with 1, maximum is cutoff with 1.
  static void add_identities(const TwoDensities& p, ExperimentResult& result) {
    const auto cutoff_variance = [&](double value) {
      return variance_of(p, weighted("", p, [value](Pair q) { return cutoff_weights(q, value); }));
    };
    const double balance = variance_of(p, weighted("", p, [](Pair q) { return power_weights(q, 1); }));
    const double maximum = variance_of(p, weighted("", p, maximum_weights));
    result.checks.push_back({"variance of cutoff 0 and balance", cutoff_variance(0), balance, 1e-12 * (1 + balance)});
    result.checks.push_back({"variance of cutoff 1 and maximum", cutoff_variance(1), maximum, 1e-12 * (1 + maximum)});
  }

  // The contributions of samples of the first density.
  metrics::FunctionChart weight_chart(const TwoDensities& p) const {
    constexpr int kPoints = 300;
    metrics::FunctionChart chart{
        .title = "Weights of the first density", .x_label = "x", .y_label = "weight", .curves = {}};
    const double low = problem == CombinedProblem::glossy ? 0.5 - static_cast<double>(width) : 0;
    for (const Heuristic& h : heuristics(p)) {
      metrics::FunctionCurve curve{.name = h.name, .points = {}};
      for (int i = 0; i < kPoints; ++i) {
        const double x = low + (1 - 2 * low) * (i + 0.5) / kPoints;
        const double weight = h.contribution(0, x) * p.pdf[0](x) / p.f(x);
        // Optimal weights diverge where f vanishes.
        if (std::abs(weight) < 2) curve.points.push_back({x, weight});
      }
      chart.curves.push_back(std::move(curve));
    }
    return chart;
  }
};

}  // namespace

Experiment mis_experiment() { return make_experiment<Mis>(); }

}  // namespace etendue::experiments
