#include "equations/fredholm.h"

#include <algorithm>
#include <cmath>

namespace etendue::equations {
namespace {

constexpr int kElementPoints = 8;   // of the Gauss rule in an element
constexpr int kOperatorPanels = 8;  // times kElementPoints nodes for norms and spectral radii

// Nodes and weights of a rule, moved to the interval of an equation.
QuadratureRule on_interval(const FredholmEquation& equation, QuadratureRule rule) {
  for (double& x : rule.nodes) x = equation.a + equation.width() * x;
  for (double& w : rule.weights) w *= equation.width();
  return rule;
}

LinearSystem operator_matrix(const QuadratureRule& rule, const std::function<double(double, double)>& k) {
  LinearSystem system = zero_system(rule.size());
  for (size_t i = 0; i < rule.size(); ++i)
    for (size_t j = 0; j < rule.size(); ++j) system.matrix[i][j] = rule.weights[j] * k(rule.nodes[i], rule.nodes[j]);
  return system;
}

// Basis functions on elements of equal width. Function `function(e, i)` is the i-th of those that are not zero in
// element e, at a position t in [0, 1] of the element.
class Elements {
 public:
  Elements(const FredholmEquation& equation, ElementBasis basis, int count)
      : equation_(equation), basis_(basis), count_(static_cast<size_t>(count)) {}

  size_t elements() const { return count_; }
  size_t functions() const { return basis_ == ElementBasis::boxes ? count_ : count_ + 1; }
  size_t per_element() const { return basis_ == ElementBasis::boxes ? 1 : 2; }
  static size_t function(size_t element, size_t local) { return element + local; }
  double value(size_t local, double t) const {
    if (basis_ == ElementBasis::boxes) return 1;
    return local == 0 ? 1 - t : t;
  }
  double width() const { return equation_.width() / static_cast<double>(count_); }
  double position(size_t element, double t) const { return equation_.a + (static_cast<double>(element) + t) * width(); }

  // The sum of the basis functions with these coefficients.
  Approximation sum(std::vector<double> coefficients) const {
    return [*this, coefficients = std::move(coefficients)](double x) {
      const double scaled = std::clamp((x - equation_.a) / width(), 0.0, static_cast<double>(count_));
      const size_t element = std::min(static_cast<size_t>(scaled), count_ - 1);
      double value_at_x = 0;
      for (size_t i = 0; i < per_element(); ++i)
        value_at_x += coefficients[function(element, i)] * value(i, scaled - static_cast<double>(element));
      return value_at_x;
    };
  }

 private:
  FredholmEquation equation_;
  ElementBasis basis_;
  size_t count_;
};

// Adds the inner products of the basis functions of two elements with the kernel between them.
void add_kernel_products(const FredholmEquation& equation, const Elements& elements, const QuadratureRule& gauss,
                         size_t row_element, size_t column_element, LinearSystem& system) {
  const double area = elements.width() * elements.width();
  for (size_t p = 0; p < gauss.size(); ++p)
    for (size_t q = 0; q < gauss.size(); ++q) {
      const double k = area * gauss.weights[p] * gauss.weights[q] *
                       equation.kernel(elements.position(row_element, gauss.nodes[p]),
                                       elements.position(column_element, gauss.nodes[q]));
      for (size_t i = 0; i < elements.per_element(); ++i)
        for (size_t j = 0; j < elements.per_element(); ++j)
          system.matrix[Elements::function(row_element, i)][Elements::function(column_element, j)] -=
              k * elements.value(i, gauss.nodes[p]) * elements.value(j, gauss.nodes[q]);
    }
}

// Adds the inner products of the basis functions of an element with each other and with the source.
void add_mass_and_source(const FredholmEquation& equation, const Elements& elements, const QuadratureRule& gauss,
                         size_t element, LinearSystem& system) {
  for (size_t p = 0; p < gauss.size(); ++p) {
    const double t = gauss.nodes[p], weight = elements.width() * gauss.weights[p];
    const double source = equation.source(elements.position(element, t));
    for (size_t i = 0; i < elements.per_element(); ++i) {
      system.right[Elements::function(element, i)] += weight * source * elements.value(i, t);
      for (size_t j = 0; j < elements.per_element(); ++j)
        system.matrix[Elements::function(element, i)][Elements::function(element, j)] +=
            weight * elements.value(i, t) * elements.value(j, t);
    }
  }
}

}  // namespace

LinearSystem nystrom_system(const FredholmEquation& equation, const QuadratureRule& unit_rule) {
  const QuadratureRule rule = on_interval(equation, unit_rule);
  LinearSystem system = operator_matrix(rule, equation.kernel);
  for (size_t i = 0; i < rule.size(); ++i) {
    for (double& entry : system.matrix[i]) entry = -entry;
    system.matrix[i][i] += 1;
    system.right[i] = equation.source(rule.nodes[i]);
  }
  return system;
}

Result<NystromSolution> solve_nystrom(const FredholmEquation& equation, const QuadratureRule& unit_rule) {
  const QuadratureRule rule = on_interval(equation, unit_rule);
  auto values = solve(nystrom_system(equation, unit_rule));
  if (!values) return values.error();
  NystromSolution solution{.nodes = rule.nodes, .values = *values, .extension = {}};
  solution.extension = [equation, rule, values = *values](double x) {
    double sum = equation.source(x);
    for (size_t i = 0; i < rule.size(); ++i) sum += rule.weights[i] * equation.kernel(x, rule.nodes[i]) * values[i];
    return sum;
  };
  return solution;
}

Result<Approximation> solve_collocation(const FredholmEquation& equation, int element_count, ElementBasis basis) {
  const Elements elements(equation, basis, element_count);
  const QuadratureRule gauss = gauss_legendre(kElementPoints);
  LinearSystem system = zero_system(elements.functions());
  for (size_t j = 0; j < system.size(); ++j) {
    const double x = elements.position(j, basis == ElementBasis::boxes ? 0.5 : 0);
    system.right[j] = equation.source(x);
    system.matrix[j][j] = 1;
    for (size_t e = 0; e < elements.elements(); ++e)
      for (size_t q = 0; q < gauss.size(); ++q) {
        const double k = elements.width() * gauss.weights[q] * equation.kernel(x, elements.position(e, gauss.nodes[q]));
        for (size_t i = 0; i < elements.per_element(); ++i)
          system.matrix[j][Elements::function(e, i)] -= k * elements.value(i, gauss.nodes[q]);
      }
  }
  auto coefficients = solve(system);
  if (!coefficients) return coefficients.error();
  return elements.sum(std::move(*coefficients));
}

Result<Approximation> solve_galerkin(const FredholmEquation& equation, ElementBasis basis, int element_count) {
  const Elements elements(equation, basis, element_count);
  const QuadratureRule gauss = gauss_legendre(kElementPoints);
  LinearSystem system = zero_system(elements.functions());
  for (size_t e = 0; e < elements.elements(); ++e) {
    add_mass_and_source(equation, elements, gauss, e, system);
    for (size_t c = 0; c < elements.elements(); ++c) add_kernel_products(equation, elements, gauss, e, c, system);
  }
  auto coefficients = solve(system);
  if (!coefficients) return coefficients.error();
  return elements.sum(std::move(*coefficients));
}

double l2_error(const FredholmEquation& equation, const Approximation& f, int panels) {
  const QuadratureRule rule = on_interval(equation, gauss_rule(kElementPoints, panels));
  double sum = 0;
  for (size_t i = 0; i < rule.size(); ++i) {
    const double difference = f(rule.nodes[i]) - equation.solution(rule.nodes[i]);
    sum += rule.weights[i] * difference * difference;
  }
  return std::sqrt(sum);
}

double spectral_radius(const FredholmEquation& equation, const std::function<double(double, double)>& k) {
  const QuadratureRule rule = on_interval(equation, gauss_rule(kElementPoints, kOperatorPanels));
  return spectral_radius(operator_matrix(rule, k).matrix);
}

double spectral_radius(const FredholmEquation& equation) { return spectral_radius(equation, equation.kernel); }

double supremum_norm(const FredholmEquation& equation) {
  const QuadratureRule rule = on_interval(equation, gauss_rule(kElementPoints, kOperatorPanels));
  double largest = 0;
  const auto integral = [&](double x) {
    double sum = 0;
    for (size_t j = 0; j < rule.size(); ++j) sum += rule.weights[j] * std::abs(equation.kernel(x, rule.nodes[j]));
    return sum;
  };
  for (const double x : rule.nodes) largest = std::max(largest, integral(x));
  for (const double x : {equation.a, equation.b})
    if (const double end = integral(x); std::isfinite(end)) largest = std::max(largest, end);
  return largest;
}

}  // namespace etendue::equations
