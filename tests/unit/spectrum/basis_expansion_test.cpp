// Expansions of spectra in basis functions: closed-form errors, projections, and colours.
#include "spectrum/basis_expansion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "spectrum/spectrum_names.h"
#include "spectrum/uplift.h"

namespace etendue {
namespace {

constexpr SpectralBasis kBases[] = {SpectralBasis::boxes, SpectralBasis::samples, SpectralBasis::trigonometric,
                                    SpectralBasis::gaussians};

// (lambda - 380) / 400, which is 0 at 380 nm and 1 at 780 nm.
Spectrum ramp() { return *Spectrum::piecewise_linear({{380, 0}, {780, 1}}); }

// For f(x) = x on [0, 1] and n boxes the L2 error is 1 / (n sqrt 12), and the norm of f is 1 / sqrt 3.
TEST(BasisExpansion, OfARampHasTheClosedFormError) {
  for (const size_t n : {1U, 4U, 10U, 40U}) {
    const BasisExpansion boxes(SpectralBasis::boxes, n, ramp());
    EXPECT_NEAR(boxes.relative_error(ramp()), 0.5 / static_cast<double>(n), 1e-5);
    const BasisExpansion samples(SpectralBasis::samples, n, ramp());
    for (size_t i = 0; i < n; ++i) EXPECT_NEAR(boxes.coefficients()[i], samples.coefficients()[i], 1e-9);
  }
}

// The Fourier coefficients of the ramp: 1/2, then 0 for cos and -1 / (pi k) for sin.
TEST(BasisExpansion, TrigonometricCoefficientsOfARamp) {
  const BasisExpansion e(SpectralBasis::trigonometric, 7, ramp());
  EXPECT_NEAR(e.coefficients()[0], 0.5, 1e-6);
  for (size_t k = 1; k <= 3; ++k) {
    EXPECT_NEAR(e.coefficients()[2 * k - 1], 0, 1e-6);
    EXPECT_NEAR(e.coefficients()[2 * k], -1 / (std::numbers::pi * static_cast<double>(k)), 1e-5);
  }
}

// Parseval's identity: the square of the norm is that of the expansion plus that of the error.
TEST(BasisExpansion, BoxesSatisfyParsevalsIdentity) {
  const Spectrum lamp = *find_spectrum("a");
  const size_t n = 8;
  const BasisExpansion e(SpectralBasis::boxes, n, lamp);
  double of_expansion = 0, norm = 0;
  for (const double c : e.coefficients()) of_expansion += c * c * 400 / static_cast<double>(n);
  for (int i = 0; i < 1600; ++i) norm += 0.25 * std::pow(lamp(380 + (i + 0.5) * 0.25), 2);
  EXPECT_NEAR(of_expansion / norm, 1 - std::pow(e.relative_error(lamp), 2), 1e-9);
}

// A constant is reproduced exactly, except by Gaussians; more functions never increase the error of nested bases.
TEST(BasisExpansion, ErrorsDecreaseWithTheNumberOfFunctions) {
  for (const SpectralBasis basis : kBases) {
    const double constant = BasisExpansion(basis, 5, Spectrum::constant(2)).relative_error(Spectrum::constant(2));
    EXPECT_LT(constant, basis == SpectralBasis::gaussians ? 0.1 : 1e-9);
    double previous = 10;
    for (const size_t n : {3U, 9U, 27U}) {
      const double error = BasisExpansion(basis, n, *find_spectrum("a")).relative_error(*find_spectrum("a"));
      EXPECT_LT(error, previous);
      previous = error;
    }
    // Periodic functions do not converge uniformly: the spectrum has different values at the ends.
    EXPECT_LT(previous, basis == SpectralBasis::trigonometric ? 0.12 : 0.06);
  }
}

// The colour by the matrix of the basis equals the integral over the expansion.
TEST(BasisExpansion, ColorsAreLinearInTheCoefficients) {
  for (const SpectralBasis basis : kBases) {
    const BasisExpansion e(basis, 9, *find_spectrum("d65"));
    double y = 0;
    for (int i = 0; i < 1600; ++i) {
      const double w = 380 + (i + 0.5) * 0.25;
      y += 0.25 * e(w) * observer_at(w).y;
    }
    EXPECT_NEAR(e.xyz().y / y, 1, 1e-9);
    EXPECT_NEAR(e.xyz().y / find_spectrum("d65")->xyz().y, 1, 0.02);
  }
}

// Three functions reproduce any colour, but not as a reflectance; the smooth spectra of uplift.h stay between 0 and 1.
TEST(BasisExpansion, OfAColorCanLeaveTheRangeOfReflectances) {
  const std::array<double, 3> red{0.9, 0.05, 0.05};
  for (const SpectralBasis basis : kBases) {
    const BasisExpansion e = BasisExpansion::of_color(basis, red);
    const auto rgb = relative_rgb_of([&](double w) { return e(w); });
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[static_cast<size_t>(c)], red[static_cast<size_t>(c)], 1e-9);
  }
  const BasisExpansion boxes = BasisExpansion::of_color(SpectralBasis::boxes, red);
  EXPECT_TRUE(boxes(450) < 0 || boxes(550) < 0 || boxes(700) > 1);
  for (int nm = 380; nm <= 780; nm += 10) {
    const float value = SigmoidSpectrum::of(Rgb(0.9f, 0.05f, 0.05f))(static_cast<float>(nm));
    EXPECT_TRUE(value >= 0 && value <= 1);
  }
}

}  // namespace
}  // namespace etendue
