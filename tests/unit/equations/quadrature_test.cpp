// Rules of integration: closed-form values, exactness for polynomials, orders of convergence, integrands that are not
// defined.
#include "equations/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace etendue::equations {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;

// The integral of cos over [0, pi/2] is 1.
double cosine(std::span<const double> x) { return kHalfPi * std::cos(kHalfPi * x[0]); }

double polynomial(std::span<const double> x, int degree) { return std::pow(x[0], degree); }

TEST(Quadrature, CosineHasTheTabulatedValues) {
  EXPECT_NEAR(*integrate(trapezoid_rule(1), 1, cosine), 0.7853981633974483, 1e-14);
  EXPECT_NEAR(*integrate(trapezoid_rule(32), 1, cosine), 0.9997991943200185, 1e-14);
  EXPECT_NEAR(*integrate(simpson_rule(1), 1, cosine), 1.0022798774922104, 1e-14);
  EXPECT_NEAR(*integrate(simpson_rule(32), 1, cosine), 1.0000000020161286, 1e-14);
  EXPECT_NEAR(*integrate(gauss_legendre(2), 1, cosine), 0.9984726134041151, 1e-13);
  EXPECT_NEAR(*integrate(gauss_legendre(3), 1, cosine), 1.0000081215554983, 1e-13);
}

TEST(Quadrature, ErrorsAreBelowTheirBounds) {
  for (const int n : {1, 2, 4, 8, 16, 32}) {
    EXPECT_LT(std::abs(*integrate(trapezoid_rule(n), 1, cosine) - 1), std::pow(kHalfPi, 3) / (12.0 * n * n)) << n;
    EXPECT_LT(std::abs(*integrate(simpson_rule(n), 1, cosine) - 1), std::pow(kHalfPi, 5) / (2880 * std::pow(n, 4)))
        << n;
  }
}

TEST(Quadrature, RulesAreExactForPolynomialsOfTheirDegree) {
  const auto cubic = [](std::span<const double> x) { return polynomial(x, 3); };
  const auto quartic = [](std::span<const double> x) { return polynomial(x, 4); };
  EXPECT_NEAR(*integrate(simpson_rule(1), 1, cubic), 0.25, 1e-15);
  EXPECT_NEAR(*integrate(simpson_rule(1), 1, quartic) - 0.2, 1.0 / 120, 1e-15);
  for (const int points : {1, 2, 5, 8, 20, 64}) {
    const int degree = 2 * points - 1;
    const auto f = [degree](std::span<const double> x) { return polynomial(x, degree); };
    EXPECT_NEAR(*integrate(gauss_legendre(points), 1, f), 1.0 / (degree + 1), 1e-13) << points;
  }
}

TEST(Quadrature, PanelsShareNodes) {
  EXPECT_EQ(trapezoid_rule(8).size(), 9u);
  EXPECT_EQ(simpson_rule(8).size(), 17u);
  EXPECT_EQ(gauss_rule(2, 8).size(), 16u);
  for (const QuadratureRule& rule : {trapezoid_rule(7), simpson_rule(5), gauss_rule(3, 4), midpoint_rule(9)}) {
    double sum = 0;
    for (const double w : rule.weights) sum += w;
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

TEST(Quadrature, TensorProductsIntegrateProducts) {
  const auto product = [](std::span<const double> x) {
    double p = 1;
    for (const double c : x) p *= kHalfPi * std::cos(kHalfPi * c);
    return p;
  };
  const double one = *integrate(simpson_rule(3), 1, cosine);
  EXPECT_NEAR(*integrate(simpson_rule(3), 4, product), std::pow(one, 4), 1e-13);
  EXPECT_EQ(tensor_evaluations(simpson_rule(3), 4), 7.0 * 7 * 7 * 7);
}

TEST(Quadrature, UndefinedValuesAreErrorsWithTheNode) {
  const auto sinc = [](std::span<const double> x) { return std::sin(x[0]) / x[0]; };
  const auto failed = integrate(trapezoid_rule(4), 2, sinc);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().message.find("not finite at x = (0, 0)"), std::string::npos) << failed.error().message;
  EXPECT_NEAR(*integrate(gauss_legendre(8), 1, sinc), 0.9460830703671830, 1e-13);
}

}  // namespace
}  // namespace etendue::equations
