// Neumann series, Jacobi, Gauss-Seidel and relaxation for an integral equation [Lang, eq. 2.385-2.415, 2.481-2.524]
//
// The equation becomes a system A y = g at the nodes of a quadrature rule, A = I - K.
//
//   Neumann       y_(n+1) = K y_n + g from y_0 = g, the partial sums of the series. Its error is at most
//                 |K|^(n+1) / (1 - |K|) |g| in the supremum norm, if |K| < 1
//   Jacobi        solves equation i for unknown i, with the old values of all others
//   Gauss-Seidel  uses the new values at once
//   relaxed       moves by a multiple of the step of Gauss-Seidel: `relaxation` above 1 is over-relaxation
//
// An iteration converges from every start if and only if the spectral radius of its iteration matrix is below 1; the radius
// is the factor of the error per step in the end. An iteration that diverges is stopped when its residual is a million
// times as large as at the start.
#include <algorithm>
#include <cmath>
#include <functional>

#include "experiments/equation_examples.h"
#include "experiments/experiment.h"

namespace etendue::experiments {
namespace {

using equations::FredholmEquation;
using equations::Iteration;
using equations::LinearSystem;

constexpr int kIterationNodes = 16;
constexpr double kDivergedResidual = 1e6;  // relative to the start
constexpr double kConvergedResidual = 1e-13;
constexpr double kSmallestErrorOfBound = 1e-9;

// y becomes K y + g, with K = I - A.
void neumann_step(const LinearSystem& system, std::vector<double>& y) {
  std::vector<double> next = system.right;
  for (size_t i = 0; i < y.size(); ++i)
    for (size_t j = 0; j < y.size(); ++j) next[i] += ((i == j ? 1 : 0) - system.matrix[i][j]) * y[j];
  y = std::move(next);
}

struct IterationHistory {
  std::vector<metrics::Point> errors;  // over the number of steps
  std::string state = "not converged";
  bool diverged = false;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

IterationHistory iterate(const LinearSystem& system, const std::vector<double>& solution, int steps,
                         std::vector<double> y, const std::function<void(std::vector<double>&)>& step) {
  IterationHistory history;
  const double first =
      std::max(equations::residual_norm(system, y), equations::residual_norm(system, std::vector<double>(y.size())));
  if (first == 0) return {.errors = {{0, 0}}, .state = "no source at the nodes"};
  for (int n = 0; n <= steps; ++n) {
    history.errors.push_back({static_cast<double>(n), largest_difference(y, solution)});
    const double residual = equations::residual_norm(system, y);
    if (!(residual <= kDivergedResidual * first)) {
      history.state = "diverges";
      history.diverged = true;
      break;
    }
    if (residual <= kConvergedResidual * first) {
      history.state = "converged";
      break;
    }
    step(y);
  }
  return history;
}

struct Iterations {
  static constexpr ExperimentDescription kDescription{
      .name = "iterations",
      .label = "Iterations for integral equations",
      .summary = "Convergence and divergence of the Neumann series, Jacobi, Gauss-Seidel and relaxation",
      .source = "[Lang, eq. 2.385-2.415, 2.481-2.524]"};

  Choice<EquationKind> equation = equation_parameter(EquationKind::cosine);
  Number<float> lambda = lambda_parameter();
  Number<float> relaxation{"relaxation",
                           "Relaxation",
                           1.2f,
                           {0.05f, 1.95f},
                           "Factor of the steps of the relaxed iteration: below 1 smaller steps, above 1 larger ones"};
  Number<int> steps{"steps", "Steps", 60, {1, 2000}, "Largest number of steps"};
  auto parameters() { return std::tie(equation, lambda, relaxation, steps); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const FredholmEquation e = make_equation(equation, static_cast<double>(lambda));
    const LinearSystem system = equations::nystrom_system(e, equations::gauss_legendre(kIterationNodes));
    const auto solution = equations::solve(system);
    if (!solution) return solution.error();
    if (!context.proceed(0)) return interrupted();
    ExperimentResult result;
    result.table.columns = {"iteration", "spectral radius", "steps", "error", "result"};
    metrics::FunctionChart chart{.title = "Error of iterations",
                                 .x_label = "steps",
                                 .y_label = "largest error at a node",
                                 .curves = {},
                                 .logarithmic_y = true};
    add_neumann(e, system, *solution, chart, result);
    const std::vector<double> zero(system.size(), 0.0);
    const auto add_sweeps = [&](const std::string& name, Iteration iteration, double omega) {
      const auto step = [&](std::vector<double>& y) { equations::sweep(system, iteration, omega, y); };
      add(name, equations::iteration_radius(system, iteration, omega), iterate(system, *solution, steps, zero, step),
          chart, result);
    };
    add_sweeps("Jacobi", Iteration::jacobi, 1);
    add_sweeps("Gauss-Seidel", Iteration::gauss_seidel, 1);
    add_sweeps("Gauss-Seidel, relaxed", Iteration::gauss_seidel, static_cast<double>(relaxation));
    result.notes.push_back(equations::is_row_dominant(system)
                               ? "The matrix is strictly diagonally dominant: Jacobi and Gauss-Seidel converge."
                               : "The matrix is not diagonally dominant: the criterion does not decide.");
    if (equations::residual_norm(system, zero) == 0)
      result.notes.push_back("The source is zero at all nodes: the rule misses the small light.");
    result.charts = {std::move(chart)};
    return result;
  }

 private:
  void add_neumann(const FredholmEquation& e, const LinearSystem& system, const std::vector<double>& solution,
                   metrics::FunctionChart& chart, ExperimentResult& result) const {
    auto kernel = system.matrix;
    for (size_t i = 0; i < kernel.size(); ++i)
      for (size_t j = 0; j < kernel.size(); ++j) kernel[i][j] = (i == j ? 1 : 0) - kernel[i][j];
    const auto step = [&](std::vector<double>& y) { neumann_step(system, y); };
    const double radius = equations::spectral_radius(kernel);
    const IterationHistory history = iterate(system, solution, steps, system.right, step);
    add("Neumann series", radius, history, chart, result);
    if (radius >= 1)
      result.notes.push_back("The Neumann series diverges: the spectral radius of the kernel is " +
                             metrics::short_number(radius) + ". Solve the linear system directly.");
    const double norm = equations::supremum_norm(e);
    if (norm >= 1) return;
    const double source = equations::residual_norm(system, std::vector<double>(system.size()));  // of zero: |g|
    metrics::FunctionCurve bound{
        .name = "bound of the Neumann series", .style = metrics::CurveStyle::dashed, .points = {}};
    double largest_ratio = 0;  // of the error to its bound, before rounding errors dominate
    for (const metrics::Point& p : history.errors) {
      bound.points.push_back({p.x, std::pow(norm, p.x + 1) / (1 - norm) * source});
      if (p.y > kSmallestErrorOfBound) largest_ratio = std::max(largest_ratio, p.y / bound.points.back().y);
    }
    result.checks.push_back({"error of the Neumann series over its bound, at most 1", largest_ratio, 0.5, 0.5 + 1e-5});
    chart.curves.push_back(std::move(bound));
  }

  static void add(const std::string& name, double radius, const IterationHistory& history,
                  metrics::FunctionChart& chart, ExperimentResult& result) {
    metrics::FunctionCurve curve{.name = name, .points = history.errors};
    result.table.rows.push_back({name, radius, history.errors.back().x, history.errors.back().y, history.state});
    // Whether the iteration diverges is what its spectral radius predicts.
    if (history.state == "converged" || history.diverged)
      result.checks.push_back({name + ": diverges", history.diverged ? 1.0 : 0.0, radius > 1 ? 1.0 : 0.0, 0});
    chart.curves.push_back(std::move(curve));
  }
};

}  // namespace

Experiment iterations_experiment() { return make_experiment<Iterations>(); }

}  // namespace etendue::experiments
