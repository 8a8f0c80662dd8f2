// Integral equations of the second kind with known solutions, and the linear systems that they lead to.
#include "equations/fredholm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace etendue::equations {
namespace {

// f = 1 + (1/4) integral of cos(x) f(y) dy over [0, pi/2] = 1 + (pi/6) cos x  [Lang, Example 2.53]
FredholmEquation cosine_equation() {
  return {.a = 0,
          .b = std::numbers::pi / 2,
          .kernel = [](double x, double) { return std::cos(x) / 4; },
          .source = [](double) { return 1.0; },
          .solution = [](double x) { return 1 + std::numbers::pi / 6 * std::cos(x); }};
}

// f = 1 + integral of ln(x y) f(y) dy over [0, 1] = 1 + ln(x)/2; its Neumann series diverges  [Lang, Example 2.52]
FredholmEquation logarithmic_equation() {
  return {.a = 0,
          .b = 1,
          .kernel = [](double x, double y) { return std::log(x * y); },
          .source = [](double) { return 1.0; },
          .solution = [](double x) { return 1 + std::log(x) / 2; }};
}

double nodal_error(const FredholmEquation& equation, const QuadratureRule& rule) {
  const auto solution = solve_nystrom(equation, rule);
  double largest = 0;
  for (size_t i = 0; i < solution->nodes.size(); ++i)
    largest = std::max(largest, std::abs(solution->values[i] - equation.solution(solution->nodes[i])));
  return largest;
}

TEST(Fredholm, NystromErrorsAreTheTabulatedOnes) {
  const FredholmEquation e = cosine_equation();
  EXPECT_NEAR(nodal_error(e, gauss_legendre(2)), 2.5190e-4, 1e-8);
  EXPECT_NEAR(nodal_error(e, gauss_legendre(4)), 3.9562e-9, 1e-12);
  EXPECT_LT(nodal_error(e, gauss_legendre(8)), 1e-14);
  EXPECT_NEAR(nodal_error(e, midpoint_rule(4)), 1.1073e-3, 1e-7);
  EXPECT_NEAR(nodal_error(e, midpoint_rule(32)), 1.7519e-5, 1e-9);
  EXPECT_NEAR(nodal_error(e, trapezoid_rule(3)), 3.9754e-3, 1e-7);
  const auto solution = solve_nystrom(e, gauss_legendre(8));
  for (const double x : {0.0, 0.3, 1.1}) EXPECT_NEAR(solution->extension(x), e.solution(x), 1e-14);
}

TEST(Fredholm, CollocationWithBoxesIsTheMidpointRuleForThisKernel) {
  const FredholmEquation e = cosine_equation();
  const auto f = solve_collocation(e, 8);
  ASSERT_TRUE(f);
  double largest = 0;
  for (int i = 0; i < 8; ++i) {
    const double x = e.width() * (i + 0.5) / 8;
    largest = std::max(largest, std::abs((*f)(x)-e.solution(x)));
  }
  EXPECT_LT(largest, 2.8e-4);
}

TEST(Fredholm, GalerkinErrorsAreTheTabulatedOnes) {
  const FredholmEquation e = cosine_equation();
  const std::pair<int, double> boxes[] = {{4, 5.2471e-2}, {8, 2.6286e-2}, {16, 1.3149e-2}, {32, 6.5753e-3}};
  for (const auto& [n, error] : boxes)
    EXPECT_NEAR(l2_error(e, *solve_galerkin(e, ElementBasis::boxes, n), 4 * n), error, 1e-4 * error) << n;
  const std::pair<int, double> hats[] = {{4, 2.7079e-3}, {8, 6.6952e-4}, {16, 1.6686e-4}, {32, 4.1681e-5}};
  for (const auto& [n, error] : hats)
    EXPECT_NEAR(l2_error(e, *solve_galerkin(e, ElementBasis::hats, n), 4 * n), error, 1e-4 * error) << n;
}

TEST(Fredholm, SpectralRadiiAndNorms) {
  EXPECT_NEAR(spectral_radius(cosine_equation()), 0.25, 1e-10);
  EXPECT_NEAR(supremum_norm(cosine_equation()), std::numbers::pi / 8, 1e-12);
  // The singularity at 0 limits the accuracy of the quadrature.
  EXPECT_NEAR(spectral_radius(logarithmic_equation()), 1 + std::numbers::sqrt2, 1e-2);
}

TEST(Fredholm, EquationWithDivergentSeriesHasASolution) {
  const FredholmEquation e = logarithmic_equation();
  const auto solution = solve_nystrom(e, gauss_rule(8, 64));
  ASSERT_TRUE(solution);
  for (const double x : {0.1, 0.5, 1.0}) EXPECT_NEAR(solution->extension(x), e.solution(x), 2e-3) << x;
}

TEST(Fredholm, EigenvalueOneIsAnError) {
  FredholmEquation e = cosine_equation();
  e.b = 1;
  e.kernel = [](double, double) { return 1.0; };
  const auto failed = solve_nystrom(e, gauss_legendre(4));
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().message.find("1 is an eigenvalue"), std::string::npos) << failed.error().message;
}

// The equations of radiosity in a cube of constant reflectance with its form factors.
LinearSystem furnace_cube(double reflectance) {
  constexpr double kOpposite = 0.1998248957, kAdjacent = 0.2000437761;
  LinearSystem system = zero_system(6);
  for (size_t i = 0; i < 6; ++i) {
    system.right[i] = 1;
    for (size_t j = 0; j < 6; ++j)
      system.matrix[i][j] = i == j ? 1 : -reflectance * (i / 2 == j / 2 ? kOpposite : kAdjacent);
  }
  return system;
}

TEST(LinearSystem, SpectralRadiiOfTheFurnaceCube) {
  for (const auto& [reflectance, jacobi, gauss_seidel] : {std::tuple(0.5, 0.5, 0.2741), std::tuple(0.9, 0.9, 0.8120)}) {
    const LinearSystem system = furnace_cube(reflectance);
    EXPECT_NEAR(iteration_radius(system, Iteration::jacobi, 1), jacobi, 1e-9);
    EXPECT_NEAR(iteration_radius(system, Iteration::gauss_seidel, 1), gauss_seidel, 2e-4);
    EXPECT_TRUE(is_row_dominant(system));
    EXPECT_NEAR((*solve(system))[0], 1 / (1 - reflectance), 1e-8);
  }
}

TEST(LinearSystem, SweepsConvergeWithTheirSpectralRadius) {
  const LinearSystem system = furnace_cube(0.9);
  for (const auto iteration : {Iteration::jacobi, Iteration::gauss_seidel})
    for (const double relaxation : {0.7, 1.0}) {
      std::vector<double> x(6, 0.0);
      for (int i = 0; i < 40; ++i) sweep(system, iteration, relaxation, x);
      const double before = residual_norm(system, x);
      sweep(system, iteration, relaxation, x);
      EXPECT_NEAR(residual_norm(system, x) / before, iteration_radius(system, iteration, relaxation), 1e-3);
    }
}

TEST(LinearSystem, DivergentJacobiIterationIsKnown) {
  const LinearSystem system{.matrix = {{1, 2}, {3, 1}}, .right = {1, 1}};
  EXPECT_NEAR(iteration_radius(system, Iteration::jacobi, 1), std::sqrt(6.0), 1e-12);
  EXPECT_FALSE(is_row_dominant(system));
}

}  // namespace
}  // namespace etendue::equations
