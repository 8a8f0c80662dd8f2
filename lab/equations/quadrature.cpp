#include "equations/quadrature.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/number_text.h"

namespace etendue::equations {
namespace {

// The rule in each of the panels. A node at the end of one panel and the start of the next is one node.
QuadratureRule composite(const QuadratureRule& rule, int panels) {
  const bool shares_ends = rule.nodes.front() == 0 && rule.nodes.back() == 1;
  QuadratureRule all;
  for (int panel = 0; panel < panels; ++panel)
    for (size_t i = 0; i < rule.size(); ++i) {
      if (i == 0 && shares_ends && panel > 0) {
        all.weights.back() += rule.weights[0] / panels;
        continue;
      }
      all.nodes.push_back((panel + rule.nodes[i]) / panels);
      all.weights.push_back(rule.weights[i] / panels);
    }
  return all;
}

class TensorProduct {
 public:
  TensorProduct(const QuadratureRule& rule, int dimension, const Integrand& integrand)
      : rule_(rule), integrand_(integrand), x_(static_cast<size_t>(dimension)) {}

  // The integral over the axes from `axis` on, at the coordinates set so far.
  double sum(size_t axis) {
    if (axis == x_.size()) return value();
    double total = 0;
    for (size_t i = 0; i < rule_.size() && undefined_at.empty(); ++i) {
      x_[axis] = rule_.nodes[i];
      total += rule_.weights[i] * sum(axis + 1);
    }
    return total;
  }

  std::string undefined_at;  // the first node where the integrand is not finite

 private:
  double value() {
    const double v = integrand_(x_);
    if (!std::isfinite(v)) undefined_at = point_text(x_);
    return v;
  }

  const QuadratureRule& rule_;
  const Integrand& integrand_;
  std::vector<double> x_;
};

}  // namespace

QuadratureRule midpoint_rule(int panels) { return composite({{0.5}, {1}}, panels); }
QuadratureRule trapezoid_rule(int panels) { return composite({{0, 1}, {0.5, 0.5}}, panels); }
QuadratureRule simpson_rule(int panels) { return composite({{0, 0.5, 1}, {1.0 / 6, 4.0 / 6, 1.0 / 6}}, panels); }
QuadratureRule gauss_rule(int points, int panels) { return composite(gauss_legendre(points), panels); }

QuadratureRule gauss_legendre(int points) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(points), beside(points - 1);
  for (int i = 1; i < points; ++i) beside[i - 1] = i / std::sqrt(4.0 * i * i - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> jacobi;
  jacobi.computeFromTridiagonal(diagonal, beside);
  QuadratureRule rule;
  for (int i = 0; i < points; ++i) {
    const double first = jacobi.eigenvectors()(0, i);
    rule.nodes.push_back(0.5 * (1 + jacobi.eigenvalues()[i]));
    rule.weights.push_back(first * first);
  }
  return rule;
}

double tensor_evaluations(const QuadratureRule& rule, int dimension) {
  return std::pow(static_cast<double>(rule.size()), dimension);
}

Result<double> integrate(const QuadratureRule& rule, int dimension, const Integrand& integrand) {
  TensorProduct product(rule, dimension, integrand);
  const double sum = product.sum(0);
  if (!product.undefined_at.empty())
    return input_error("the integrand is not finite at x = " + product.undefined_at +
                       "; use a rule without a node there");
  return sum;
}

std::string point_text(std::span<const double> x) {
  std::string text = "(";
  for (const double c : x) text += (text.size() > 1 ? ", " : "") + format_number(c);
  return text + ")";
}

}  // namespace etendue::equations
