// Integral equations of the second kind: methods that turn them into linear systems, and their orders
// [Lang, eq. 2.419-2.473]
//
//   f(x) = g(x) + integral of k(x, y) f(y) dy
//
//   Nystrom      values at the nodes of a quadrature rule. The error has the order of the rule: n^-2 for midpoint and
//                trapezoid, faster than every power for Gauss nodes and a smooth kernel
//   collocation  constant in n elements; the residual is zero at the middle of each of them; n^-2 there
//   Galerkin     constant in n elements; the residual is orthogonal to the constants; n^-1 in the norm of L^2
//   finite elements  continuous and linear in n elements, also orthogonal; n^-2 in the norm of L^2
//
// The error of Nystrom and collocation is the largest one at the nodes, that of the other two methods the norm of L^2.
// Linear systems are solved directly. A kernel with the eigenvalue 1 makes them singular. The direct solution also exists
// where the Neumann series diverges: with the kernel ln(xy) the spectral radius is 1 + sqrt(2). The logarithm is singular at
// 0, which lowers the orders.
#include <algorithm>
#include <cmath>

#include "experiments/equation_examples.h"
#include "experiments/error_curves.h"

namespace etendue::experiments {
namespace {

using equations::Approximation;
using equations::ElementBasis;
using equations::FredholmEquation;
using equations::QuadratureRule;

constexpr double kFredholmRounding = 1e-13;  // errors below this are rounding errors
constexpr int kNormPanels = 4;               // per element, for the norm of L^2

Result<double> nystrom_error(const FredholmEquation& equation, const QuadratureRule& rule) {
  const auto solution = equations::solve_nystrom(equation, rule);
  if (!solution) return solution.error();
  double largest = 0;
  for (size_t i = 0; i < solution->nodes.size(); ++i)
    largest = std::max(largest, std::abs(solution->values[i] - equation.solution(solution->nodes[i])));
  return largest;
}

Result<double> collocation_error(const FredholmEquation& equation, int n) {
  const auto f = equations::solve_collocation(equation, n);
  if (!f) return f.error();
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    const double x = equation.a + equation.width() * (i + 0.5) / n;
    largest = std::max(largest, std::abs((*f)(x)-equation.solution(x)));
  }
  return largest;
}

template <ElementBasis basis>
Result<double> galerkin_error(const FredholmEquation& equation, int n) {
  const auto f = equations::solve_galerkin(equation, basis, n);
  if (!f) return f.error();
  return equations::l2_error(equation, *f, kNormPanels * n);
}

struct Discretization {
  const char* name;
  Result<double> (*error)(const FredholmEquation&, int n);
  int order;  // of the error; 0: faster than every power
  bool has_node_at_ends = false;
};
const Discretization kDiscretizations[] = {
    {"Nystrom, midpoint", [](const auto& e, int n) { return nystrom_error(e, equations::midpoint_rule(n)); }, 2},
    {"Nystrom, trapezoid", [](const auto& e, int n) { return nystrom_error(e, equations::trapezoid_rule(n)); }, 2,
     true},
    {"Nystrom, Gauss", [](const auto& e, int n) { return nystrom_error(e, equations::gauss_legendre(n)); }, 0},
    {"collocation", collocation_error, 2},
    {"Galerkin, constant elements", galerkin_error<ElementBasis::boxes>, 1},
    {"finite elements, linear", galerkin_error<ElementBasis::hats>, 2}};

struct Fredholm {
  static constexpr ExperimentDescription kDescription{
      .name = "fredholm",
      .label = "Integral equations as linear systems",
      .summary = "Errors of Nystrom, collocation, Galerkin and finite element methods over the number of unknowns",
      .source = "[Lang, eq. 2.348, 2.419-2.473]"};

  Choice<EquationKind> equation = equation_parameter(EquationKind::cosine);
  Number<float> lambda = lambda_parameter();
  Number<int> unknowns{
      "unknowns", "Unknowns",        64, {4, 512}, "Largest number of nodes or elements. Higher is slower",
      "",         Scale::logarithmic};
  auto parameters() { return std::tie(equation, lambda, unknowns); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const FredholmEquation e = make_equation(equation, static_cast<double>(lambda));
    std::vector<double> work;
    for (int n = 2; n <= unknowns; n = n % 3 == 0 ? n / 3 * 4 : n * 3 / 2) work.push_back(n);  // 2, 3, 4, 6, 8, 12 ...
    ExperimentResult result;
    result.table.columns = {"method", "unknowns", "error", "slope"};
    ErrorChart chart{.title = "Error of the solution", .work = "unknowns", .error = "error", .curves = {}};
    for (const Discretization& method : kDiscretizations) {
      if (equation == EquationKind::logarithmic && method.has_node_at_ends) {
        result.notes.push_back(std::string(method.name) + ": the kernel ln(xy) is not finite at the node 0.");
        continue;
      }
      std::vector<double> errors;
      for (const double n : work) {
        if (!context.proceed(0)) return interrupted();
        const auto error = method.error(e, static_cast<int>(n));
        if (!error) return Error{error.error().fault, std::string(method.name) + ": " + error.error().message};
        errors.push_back(*error);
      }
      const double last = errors.back();
      for (double& error : errors)
        if (error < kFredholmRounding) error = 0;  // not drawn
      chart.curves.push_back(error_curve(method.name, work, errors));
      add_slope(method, chart.curves.back(), last, result);
    }
    add_notes(e, result);
    result.charts = {std::move(chart), solution_chart(e)};
    return result;
  }

 private:
  // The solution of a constant kernel and source is in the space of all methods, so that only rounding errors remain.
  void add_slope(const Discretization& method, const metrics::MethodCurves& curve, double last,
                 ExperimentResult& result) const {
    const auto s = slope(curve, 8, kFredholmRounding);
    result.table.rows.push_back(
        {std::string(method.name), curve.repeats[0].points.back().spp, last, s.known ? s.value : NAN});
    if (equation != EquationKind::cosine && equation != EquationKind::separable) return;
    if (method.order == 0)
      result.checks.push_back({std::string(method.name) + ": error", last, 0, kFredholmRounding});
    else if (s.known)
      result.checks.push_back(
          {std::string(method.name) + ": slope", s.value, -static_cast<double>(method.order), 0.05});
  }

  static void add_notes(const FredholmEquation& e, ExperimentResult& result) {
    const double radius = equations::spectral_radius(e);
    result.notes.push_back("Spectral radius of the kernel: " + metrics::short_number(radius) +
                           (radius < 1 ? "." : ". The Neumann series diverges; the linear system has a solution."));
  }

  // The solution, and its approximations by few elements.
  static metrics::FunctionChart solution_chart(const FredholmEquation& e) {
    constexpr int kElements = 4, kPoints = 200;
    metrics::FunctionCurve exact{.name = "solution", .points = {}};
    metrics::FunctionCurve boxes{.name = "Galerkin, 4 constant elements", .points = {}};
    metrics::FunctionCurve hats{.name = "4 linear finite elements", .points = {}};
    const auto constant = equations::solve_galerkin(e, ElementBasis::boxes, kElements);
    const auto linear = equations::solve_galerkin(e, ElementBasis::hats, kElements);
    for (int i = 0; i < kPoints; ++i) {
      const double x = e.a + e.width() * (i + 0.5) / kPoints;
      exact.points.push_back({x, e.solution(x)});
      boxes.points.push_back({x, (*constant)(x)});
      hats.points.push_back({x, (*linear)(x)});
    }
    return {.title = "Solution", .x_label = "x", .y_label = "f", .curves = {exact, boxes, hats}};
  }
};

}  // namespace

Experiment fredholm_experiment() { return make_experiment<Fredholm>(); }

}  // namespace etendue::experiments
