// Antithetic variates: exact for linear functions, no gain for symmetric ones
#include "sampling/antithetic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/sampling/points.h"

namespace etendue {
namespace {

TEST(Antithetic, PairsAreMirrored) {
  for (const uint32_t seed : {3U, 77U}) {
    const auto p = test::points(AntitheticSampler(), seed, 64, 10), random = test::points(RandomSampler(), seed, 32, 10);
    for (size_t i = 0; i < p.size(); i += 2) {
      EXPECT_EQ(p[i], random[i / 2]);
      for (size_t d = 0; d < p[i].size(); ++d) EXPECT_EQ(p[i][d] + p[i + 1][d], 1 - 0x1p-24f);
    }
  }
}

// N times the variance of the mean of N samples, from many pixels.
template <class Function>
double variance(const Sampler& sampler, double integral, Function&& f) {
  constexpr uint32_t kPixels = 20'000, kSamples = 4;
  double squares = 0;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    double sum = 0;
    for (const auto& p : test::points(sampler, mix_bits(pixel + 1), kSamples, 2)) sum += f(p[9]) - integral;
    squares += sum * sum / kSamples / kPixels;
  }
  return squares;
}

// Per sample: x^2 has the variance 4/45 and the covariance -7/90, exp x 0.2420356 and -0.2342106 [Lang, sec. 6.5.5]. The
// bounds are above 4.5 relative standard errors, sqrt(3 / pixels) for the heavier tails of few samples.
TEST(Antithetic, VariancesAreTheClosedForms) {
  const double bound = 4.5 * std::sqrt(3.0 / 20'000);
  const auto square = [](double x) { return x * x; };
  const auto symmetric = [](double x) { return (x - 0.5) * (x - 0.5); };
  const auto exponential = [](double x) { return std::exp(x); };
  const AntitheticSampler antithetic;
  const RandomSampler random;
  EXPECT_NEAR(variance(random, 1.0 / 3, square) / (4.0 / 45), 1, bound);
  EXPECT_NEAR(variance(antithetic, 1.0 / 3, square) / (1.0 / 90), 1, bound);
  EXPECT_NEAR(variance(antithetic, std::exp(1.0) - 1, exponential) / (2 * 0.0039124969), 1, bound);
  EXPECT_NEAR(variance(random, 1.0 / 12, symmetric) / (1.0 / 180), 1, bound);
  EXPECT_NEAR(variance(antithetic, 1.0 / 12, symmetric) / (2.0 / 180), 1, bound);
  EXPECT_LT(variance(antithetic, 0.5, [](double x) { return x; }), 1e-12);
}

}  // namespace
}  // namespace etendue
