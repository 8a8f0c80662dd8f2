// Rules of numerical integration over [0, 1]^s: equidistant and Gaussian nodes, composite rules and tensor products
// [Lang, sec. 6.1].
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "base/result.h"

namespace etendue::equations {

// The sum of w_i f(x_i) approximates the integral of f over [0, 1].
struct QuadratureRule {
  std::vector<double> nodes, weights;
  size_t size() const { return nodes.size(); }
};

// Each of these divides the interval into `panels` >= 1 of equal width.
QuadratureRule midpoint_rule(int panels);
QuadratureRule trapezoid_rule(int panels);  // [Lang, eq. 6.21]
QuadratureRule simpson_rule(int panels);    // with the middle of each panel [Lang, eq. 6.23]
QuadratureRule gauss_rule(int points, int panels);

// Nodes and weights of Gauss and Legendre, exact for polynomials of degree 2 points - 1: eigenvalues of the Jacobi matrix
// [Golub and Welsch 1969].
QuadratureRule gauss_legendre(int points);

using Integrand = std::function<double(std::span<const double>)>;

// The number of evaluations of a tensor product, as a floating-point number because it grows exponentially.
double tensor_evaluations(const QuadratureRule& rule, int dimension);

// The tensor product of the rule [Lang, eq. 6.30]. An input error names the first node where the integrand is not
// finite. `dimension` >= 1.
Result<double> integrate(const QuadratureRule& rule, int dimension, const Integrand& integrand);

// "(0, 0.5)"
std::string point_text(std::span<const double> x);

}  // namespace etendue::equations
