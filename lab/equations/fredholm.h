// Linear integral equations of Fredholm's second kind on an interval [Lang, eq. 2.348]:
//
//   f(x) = g(x) + integral from a to b of k(x, y) f(y) dy
//
// Methods that turn an equation into a system of linear equations.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "equations/linear_system.h"
#include "equations/quadrature.h"

namespace etendue::equations {

struct FredholmEquation {
  double a = 0, b = 1;
  std::function<double(double, double)> kernel;  // k(x, y)
  std::function<double(double)> source;          // g
  std::function<double(double)> solution;        // f in closed form; empty if none is known
  double width() const { return b - a; }
};

// An approximation of f.
using Approximation = std::function<double(double)>;

// The system (I - K W) y = g at the nodes of a rule [Lang, eq. 2.427].
LinearSystem nystrom_system(const FredholmEquation& equation, const QuadratureRule& rule);
// The solution at the nodes, and its extension by the equation itself: f(x) = g(x) + sum of w_i k(x, x_i) y_i.
struct NystromSolution {
  std::vector<double> nodes, values;
  Approximation extension;
};
Result<NystromSolution> solve_nystrom(const FredholmEquation& equation, const QuadratureRule& rule);

// Piecewise polynomials over n elements of equal width [Lang, eq. 2.458-2.464].
enum class ElementBasis {
  boxes,  // constant in each element
  hats,   // continuous, linear in each element
};

// The residual is zero at the middle of each element for boxes, at the ends of the elements for hats [Lang, eq. 2.439].
Result<Approximation> solve_collocation(const FredholmEquation& equation, int elements,
                                        ElementBasis basis = ElementBasis::boxes);
// The residual is orthogonal to the basis [Lang, eq. 2.456]; with hats this is a finite element method.
Result<Approximation> solve_galerkin(const FredholmEquation& equation, ElementBasis basis, int elements);

// The root of the integral of (f - solution)^2, by Gauss rules in `panels` parts of the interval.
double l2_error(const FredholmEquation& equation, const Approximation& f, int panels);

// The spectral radius of the integral operator with kernel `k`, from its Nystrom matrix.
double spectral_radius(const FredholmEquation& equation, const std::function<double(double, double)>& k);
double spectral_radius(const FredholmEquation& equation);
// The norm of the operator in the space of bounded functions: the supremum over x of the integral of |k(x, y)| dy.
double supremum_norm(const FredholmEquation& equation);

}  // namespace etendue::equations
