// One unknown of x = A x + b by random paths [Lang, eq. 2.906-2.920; Forsythe and Leibler 1950]
//
// This is the method of von Neumann and Ulam.
// A path starts at the unknown j and goes from i to k with probability |a_ik| / (sum of |a_il| over l). Its weight is the
// product of a_ik over these probabilities. A path of m steps has the estimate
//
//   X = b_j + sum over k from 1 to m of  weight_k b_(i_k),     E X = component j of the sum of A^i b for i <= m
//
// exactly: m is the number of terms of the Neumann series, and its truncation is a bias. The other unknowns need not be
// computed.
//
//   two        A = ((0.1, 0.2), (0.3, 0.4)), b = (1, 2); x = (25/12, 35/8)
//   furnace    radiosity in a closed cube with the given reflectance: x = 1 / (1 - reflectance) for all six faces
//   divergent  A = ((0, -2), (-3, 0)): the Jacobi iteration of a system with a solution; its spectral radius sqrt(6) is
//              above 1, so that the estimates have no limit
#include <array>
#include <cmath>

#include "equations/linear_system.h"
#include "equations/random_numbers.h"
#include "experiments/error_curves.h"
#include "experiments/moments.h"

namespace etendue::experiments {

enum class SolvedSystem { two, furnace, divergent };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::SolvedSystem> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"two", "Two unknowns"}, {"furnace", "Radiosity in a cube"}, {"divergent", "Spectral radius above 1"}}};
};

namespace etendue::experiments {
namespace {

using Rows = std::vector<std::vector<double>>;

// x = A x + b
struct FixedPointSystem {
  Rows a;
  std::vector<double> b;
};

FixedPointSystem furnace_system(double reflectance) {
  constexpr size_t kFaces = 6;
  constexpr double kOpposite = 0.1998248957, kAdjacent = (1 - kOpposite) / 4;  // form factors of a cube
  FixedPointSystem system{.a = Rows(kFaces, std::vector(kFaces, 0.0)), .b = std::vector(kFaces, 1.0)};
  for (size_t i = 0; i < kFaces; ++i)
    for (size_t j = 0; j < kFaces; ++j)
      if (i != j) system.a[i][j] = reflectance * (i / 2 == j / 2 ? kOpposite : kAdjacent);
  return system;
}

struct LinearWalks {
  static constexpr ExperimentDescription kDescription{
      .name = "linear-walks",
      .label = "Linear systems by random paths",
      .summary = "The method of von Neumann and Ulam: bias of truncated paths and error over the number of paths",
      .source = "[Lang, eq. 2.906-2.920; Forsythe and Leibler 1950]"};

  Choice<SolvedSystem> system{"system", "System", SolvedSystem::two, "The system x = A x + b"};
  Number<float> reflectance{"reflectance", "Reflectance", 0.5f, {0, 0.99f}, "Share of light that the cube reflects"};
  Number<int> length{"length", "Path length", 8, {1, 256}, "Number of steps of a path. Higher has less bias"};
  Number<int> paths{"paths", "Paths", 16384, {64, 1048576}, "Number of paths of an estimate", "", Scale::logarithmic};
  auto parameters() { return std::tie(system, reflectance, length, paths); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const FixedPointSystem s = make_system();
    const double radius = equations::spectral_radius(s.a);
    if (radius >= 1)
      return input_error("the Neumann series diverges: the spectral radius of A is " + metrics::short_number(radius) +
                         ", so that the estimates have no limit; solve the system directly");
    const double solution = exact_solution(s);
    auto curves = error_curves_of(s, solution, context);
    if (!curves) return curves.error();
    ExperimentResult result = summary(s, solution, context.seed);
    result.charts.emplace_back(
        ErrorChart{.title = "Error of the first unknown", .work = "paths", .curves = {std::move(*curves)}});
    return result;
  }

 private:
  FixedPointSystem make_system() const {
    if (system == SolvedSystem::two) return {.a = {{0.1, 0.2}, {0.3, 0.4}}, .b = {1, 2}};
    if (system == SolvedSystem::furnace) return furnace_system(static_cast<double>(reflectance));
    return {.a = {{0, -2}, {-3, 0}}, .b = {1, 1}};
  }

  // The first unknown of (I - A) x = b.
  static double exact_solution(const FixedPointSystem& s) {
    equations::LinearSystem direct{.matrix = s.a, .right = s.b};
    for (size_t i = 0; i < s.b.size(); ++i)
      for (size_t j = 0; j < s.b.size(); ++j) direct.matrix[i][j] = (i == j ? 1 : 0) - s.a[i][j];
    return (*equations::solve(direct))[0];
  }

  // The first component of the sum of A^i b, for i from 0 to each number of steps.
  std::vector<double> partial_sums(const FixedPointSystem& s) const {
    std::vector<double> x = s.b, sums{s.b[0]};
    for (int m = 1; m <= length; ++m) {
      std::vector<double> next = s.b;
      for (size_t i = 0; i < x.size(); ++i)
        for (size_t j = 0; j < x.size(); ++j) next[i] += s.a[i][j] * x[j];
      x = next;
      sums.push_back(x[0]);
    }
    return sums;
  }

  // One step: chooses the next unknown and returns the factor of the weight. Zero if the row is zero.
  static double step(const std::vector<double>& row, equations::RandomNumbers& random, size_t& state) {
    double sum = 0;
    for (const double a : row) sum += std::abs(a);
    double u = random.uniform() * sum;
    for (size_t j = 0; j < row.size(); ++j) {
      if (row[j] == 0) continue;
      state = j;  // the last one if rounding errors leave a rest of u
      u -= std::abs(row[j]);
      if (u < 0) break;
    }
    return sum > 0 ? std::copysign(sum, row[state]) : 0;
  }

  // The estimates after each number of steps of one path.
  void trace_path(const FixedPointSystem& s, equations::RandomNumbers& random, std::vector<double>& estimates) const {
    size_t state = 0;
    double weight = 1;
    estimates.assign(1, s.b[0]);
    for (int m = 1; m <= length; ++m) {
      weight *= step(s.a[state], random, state);
      estimates.push_back(estimates.back() + weight * s.b[state]);
    }
  }

  Result<metrics::MethodCurves> error_curves_of(const FixedPointSystem& s, double solution,
                                                const RunContext& context) const {
    const auto work = powers_of_two(2, static_cast<int>(std::log2(paths.value)));
    const auto errors = [&](int repeat, std::span<double> out) {
      equations::RandomNumbers random(mix_bits(context.seed) + static_cast<uint64_t>(repeat) + 1);
      std::vector<double> estimates;
      double sum = 0;
      size_t k = 0;
      for (int i = 1; k < work.size(); ++i) {
        trace_path(s, random, estimates);
        sum += estimates.back();
        if (i == static_cast<int>(work[k])) out[k++] = sum / i - solution;
      }
    };
    return rms_error_curves(std::to_string(length) + " steps", work, {}, errors, context);
  }

  ExperimentResult summary(const FixedPointSystem& s, double solution, uint64_t seed) const {
    std::vector<Moments> moments(static_cast<size_t>(length) + 1);
    equations::RandomNumbers random(mix_bits(seed));
    std::vector<double> estimates;
    for (int i = 0; i < paths; ++i) {
      trace_path(s, random, estimates);
      for (size_t m = 0; m < moments.size(); ++m) moments[m].add(estimates[m]);
    }
    ExperimentResult result;
    result.table.columns = {"steps", "mean", "standard error", "terms of the series", "bias"};
    metrics::FunctionCurve bias{.name = "bias of the terms", .style = metrics::CurveStyle::dashed, .points = {}};
    metrics::FunctionCurve measured{.name = "measured", .points = {}};
    const std::vector<double> sums = partial_sums(s);
    for (size_t m = 0; m < sums.size(); ++m) {
      const auto n = static_cast<double>(m);
      result.table.rows.push_back({n, moments[m].mean(), moments[m].mean_error(), sums[m], sums[m] - solution});
      result.checks.push_back({"mean after " + std::to_string(m) + " steps", moments[m].mean(), sums[m],
                               kStandardErrors * moments[m].mean_error() + 1e-12 * std::abs(solution)});
      bias.points.push_back({n, std::abs(sums[m] - solution)});
      measured.points.push_back({n, std::abs(moments[m].mean() - solution)});
    }
    result.notes.push_back("The solution is " + metrics::short_number(solution) + ".");
    result.charts.emplace_back(metrics::FunctionChart{.title = "Bias of truncated paths",
                                                      .x_label = "steps",
                                                      .y_label = "distance to the solution",
                                                      .curves = {measured, bias},
                                                      .logarithmic_y = true});
    return result;
  }
};

}  // namespace

Experiment linear_walks_experiment() { return make_experiment<LinearWalks>(); }

}  // namespace etendue::experiments
