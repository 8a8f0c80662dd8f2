// Spherical harmonics: closed forms, orthonormality, rotation, the clamped cosine, and radiance transfer.
#include "base/spherical_harmonics.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace etendue {
namespace {

constexpr double kPiD = std::numbers::pi;

const HarmonicDirection kDirections[] = {{0, 0, 1},         {0, 0, -1},          {1, 0, 0},
                                         {0.48, 0.6, 0.64}, {-0.6, 0.64, -0.48}, {0.28, -0.96, 0}};

glm::dmat3 turn(double degrees, const glm::dvec3& axis) {
  return glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::normalize(axis)));
}

// sqrt(1/(4 pi)), sqrt(3/(4 pi)) (-y, z, -x), and band 2, with the sign of Condon and Shortley.
TEST(SphericalHarmonics, FirstBandsInClosedForm) {
  for (const auto& w : kDirections) {
    const double c1 = std::sqrt(3 / (4 * kPiD)), c2 = std::sqrt(15 / (4 * kPiD));
    EXPECT_NEAR(real_harmonic(0, 0, w), std::sqrt(1 / (4 * kPiD)), 1e-15);
    EXPECT_NEAR(real_harmonic(1, -1, w), -c1 * w.y, 1e-15);
    EXPECT_NEAR(real_harmonic(1, 0, w), c1 * w.z, 1e-15);
    EXPECT_NEAR(real_harmonic(1, 1, w), -c1 * w.x, 1e-15);
    EXPECT_NEAR(real_harmonic(2, -2, w), c2 * w.x * w.y, 1e-15);
    EXPECT_NEAR(real_harmonic(2, -1, w), -c2 * w.y * w.z, 1e-15);
    EXPECT_NEAR(real_harmonic(2, 0, w), std::sqrt(5 / (16 * kPiD)) * (3 * w.z * w.z - 1), 1e-15);
    EXPECT_NEAR(real_harmonic(2, 1, w), -c2 * w.x * w.z, 1e-15);
    EXPECT_NEAR(real_harmonic(2, 2, w), c2 / 2 * (w.x * w.x - w.y * w.y), 1e-15);
  }
}

TEST(SphericalHarmonics, RealAndComplexFunctionsAgree) {
  for (const auto& w : kDirections) {
    const auto all = real_harmonics(8, w);
    for (int l = 0; l < 8; ++l)
      for (int m = -l; m <= l; ++m) {
        EXPECT_NEAR(all[harmonic_index(l, m)], real_harmonic(l, m, w), 1e-13) << l << ' ' << m;
        const auto y = complex_harmonic(l, std::abs(m), w);
        const double expected = m == 0 ? y.real() : std::numbers::sqrt2 * (m > 0 ? y.real() : y.imag());
        EXPECT_NEAR(real_harmonic(l, m, w), expected, 1e-14) << l << ' ' << m;
        // Y_l,-m = (-1)^m conj(Y_lm)
        const auto mirrored = complex_harmonic(l, -m, w), conjugate = std::conj(complex_harmonic(l, m, w));
        EXPECT_NEAR(std::abs(mirrored - (m % 2 == 0 ? conjugate : -conjugate)), 0, 1e-14);
      }
  }
}

// The projection of Y_lm is the unit vector of its index: the Gram matrix is the identity.
TEST(SphericalHarmonics, AreOrthonormal) {
  for (int l = 0; l < 7; ++l)
    for (int m = -l; m <= l; ++m) {
      const auto c = project_on_harmonics([&](const auto& w) { return real_harmonic(l, m, w); }, 7, 16);
      for (size_t i = 0; i < c.size(); ++i)
        EXPECT_NEAR(c[i], i == harmonic_index(l, m) ? 1 : 0, 1e-13) << l << ' ' << m;
    }
}

// The theorem of addition: the sum of Y_lm(a) Y_lm(b) over m is (2 l + 1) / (4 pi) P_l(a . b).
TEST(SphericalHarmonics, AdditionTheorem) {
  const auto &a = kDirections[3], &b = kDirections[4];
  for (int l = 0; l < 12; ++l) {
    double sum = 0;
    for (int m = -l; m <= l; ++m) sum += real_harmonic(l, m, a) * real_harmonic(l, m, b);
    EXPECT_NEAR(sum, (2 * l + 1) / (4 * kPiD) * std::legendre(static_cast<unsigned>(l), glm::dot(a, b)), 1e-13);
  }
}

TEST(SphericalHarmonics, RotationMovesTheFunction) {
  HarmonicCoefficients c(harmonic_count(6));
  for (size_t i = 0; i < c.size(); ++i) c[i] = std::cos(1.7 * static_cast<double>(i));
  const glm::dmat3 first = turn(37, {1, 2, 3}), second = turn(-110, {0.3, -1, 0.2});
  const auto rotated = rotate_harmonics(c, first);
  for (const auto& w : kDirections)
    EXPECT_NEAR(evaluate_harmonics(rotated, first * w), evaluate_harmonics(c, w), 1e-13);
  // Bands keep their energy, and rotations are composed.
  for (int l = 0; l < 6; ++l) {
    double before = 0, after = 0;
    for (int m = -l; m <= l; ++m) {
      before += c[harmonic_index(l, m)] * c[harmonic_index(l, m)];
      after += rotated[harmonic_index(l, m)] * rotated[harmonic_index(l, m)];
    }
    EXPECT_NEAR(after, before, 1e-12);
  }
  const auto twice = rotate_harmonics(rotated, second), at_once = rotate_harmonics(c, second * first);
  for (size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(twice[i], at_once[i], 1e-12);
}

// The values in [Lang, sec. 2.1] follow from integrals of the Legendre polynomials.
TEST(SphericalHarmonics, ClampedCosine) {
  const double expected[] = {0.8862269255, 1.0233267079, 0.4954159122, 0, -0.1107783657, 0, 0.0499271347};
  const auto c = project_on_harmonics([](const auto& w) { return std::max(w.z, 0.0); }, 12);
  for (int l = 0; l < 12; ++l)
    for (int m = -l; m <= l; ++m)
      EXPECT_NEAR(c[harmonic_index(l, m)], m == 0 ? clamped_cosine_coefficient(l) : 0, 1e-12) << l << ' ' << m;
  for (int l = 0; l < 7; ++l) EXPECT_NEAR(clamped_cosine_coefficient(l), expected[l], 1e-10) << l;
}

// Irradiance of any normal from nine numbers [Ramamoorthi and Hanrahan 2001]: exact for radiance of three bands.
TEST(SphericalHarmonics, IrradianceIsAConvolution) {
  const auto radiance = [](const HarmonicDirection& w) { return 1 + 0.5 * w.x - 0.2 * w.z + 0.7 * w.x * w.y; };
  std::vector<double> cosine;
  for (int l = 0; l < 3; ++l) cosine.push_back(clamped_cosine_coefficient(l));
  const auto irradiance = convolve_harmonics(project_on_harmonics(radiance, 3), cosine);
  for (const auto& n : kDirections) {
    // pi times the constant, 2 pi / 3 times the linear and pi / 4 times the quadratic terms.
    const double expected = kPiD + 2 * kPiD / 3 * (0.5 * n.x - 0.2 * n.z) + kPiD / 4 * 0.7 * n.x * n.y;
    EXPECT_NEAR(evaluate_harmonics(irradiance, n), expected, 1e-13);
  }
}

// Radiance transfer: a point beside a wall sees half of the sky. The product of the coefficients of the radiance and of
// the transfer function, visibility times cosine, is the irradiance, also after the light has been rotated.
TEST(SphericalHarmonics, RadianceTransfer) {
  constexpr int kBands = 5;
  const auto transfer =
      project_on_harmonics([](const HarmonicDirection& w) { return w.x > 0 ? std::max(w.z, 0.0) : 0.0; }, kBands, 256);
  const auto sky = [](const HarmonicDirection& w) { return 2 + w.x + 0.5 * w.z * w.z * w.x; };
  const auto radiance = project_on_harmonics(sky, kBands);
  // The integrals of cos, x cos and x z^2 cos over the visible quarter are pi/2, 2/3 and 4/15.
  EXPECT_NEAR(harmonic_product(radiance, transfer), 2 * kPiD / 2 + 2.0 / 3 + 0.5 * 4.0 / 15, 1e-4);
  // Half a turn about the normal changes the sign of x.
  const auto turned = rotate_harmonics(radiance, turn(180, {0, 0, 1}));
  EXPECT_NEAR(harmonic_product(turned, transfer), 2 * kPiD / 2 - 2.0 / 3 - 0.5 * 4.0 / 15, 1e-4);
}

}  // namespace
}  // namespace etendue
