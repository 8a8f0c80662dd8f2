// Convergence analysis: slopes, quantile bands, efficiency, bias and variance. Every test has a fixed seed, so that it
// is reproducible; the stated false-alarm rates are those of a new seed.
#include "metrics/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace etendue::test {
namespace {

using namespace metrics;

// error = scale * seconds^slope at log-spaced times, with 100 samples per second.
ErrorCurve power_law(double scale, double slope, int points = 12) {
  ErrorCurve curve;
  for (const double t : log_grid(0.1, 10, points)) {
    const double rmse = scale * std::pow(t, slope);
    curve.points.push_back({t, 100 * t, rmse * rmse, 2 * rmse * rmse, 0});
  }
  return curve;
}

MethodCurves method_of(std::vector<ErrorCurve> repeats) {
  MethodCurves method{"m", std::move(repeats)};
  for (size_t i = 0; i < method.repeats.size(); ++i) method.repeats[i].repeat = static_cast<int>(i);
  return method;
}

// Pixels that are running means of independent samples: the errors along a curve are correlated as those of a
// rendering.
ErrorCurve running_means(std::mt19937& random, int pixels) {
  std::normal_distribution<double> normal;
  std::vector<double> sums(static_cast<size_t>(pixels));
  ErrorCurve curve;
  double n = 0;
  for (const double next : {1, 2, 4, 8, 16, 32, 64, 128, 256}) {
    ErrorPoint p;
    p.spp = next;
    p.seconds = 0.01 * next;
    for (double& sum : sums) {
      sum += normal(random) * std::sqrt(next - n);
      p.mse += std::pow(sum / next, 2) / pixels;
      p.bias += sum / next / pixels;
    }
    n = next;
    curve.points.push_back(p);
  }
  return curve;
}

// Quantiles of Student's t for 95 % intervals.
constexpr double kStudent7 = 2.365, kStudent18 = 2.101;
// Of 500 intervals of 95 %, 475 +- 4.87 contain the true value. 3.3 standard deviations are exceeded once in 1000, on
// both sides together.
constexpr double kRuns = 500, kExpected = 475, kAllowed = 3.3 * 4.873;

TEST(LineFit, FindsALine) {
  const LinePoint points[] = {{0, 1}, {1, 3}, {2, 5, 10}, {7, 15, 0.1}};
  const LineFit fit = fit_line(points);
  ASSERT_TRUE(fit.known);
  EXPECT_NEAR(fit.slope, 2, 1e-12);
  EXPECT_NEAR(fit.intercept, 1, 1e-12);
  EXPECT_NEAR(fit.slope_error, 0, 1e-9);
}

TEST(LineFit, WeightsAreRespected) {
  // The third point has weight zero.
  const LinePoint points[] = {{0, 0}, {1, 1}, {2, 100, 0}};
  EXPECT_NEAR(fit_line(points).slope, 1, 1e-12);
}

TEST(LineFit, NeedsTwoAbscissas) {
  const LinePoint one[] = {{1, 1}}, same[] = {{1, 1}, {1, 2}};
  EXPECT_FALSE(fit_line({}).known);
  EXPECT_FALSE(fit_line(one).known);
  EXPECT_FALSE(fit_line(same).known);
}

TEST(LineFit, StandardErrorsAreCalibrated) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int held = 0;
  double mean = 0;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<LinePoint> points;
    for (int i = 0; i < 20; ++i) {
      const double sigma = 0.02 * (1 + i % 3);
      points.push_back({0.3 * i, 1 - 0.15 * i + sigma * normal(random), 1 / (sigma * sigma)});
    }
    const LineFit fit = fit_line(points);
    held += std::abs(fit.slope + 0.5) <= kStudent18 * fit.slope_error;
    mean += fit.slope / kRuns;
  }
  EXPECT_NEAR(held, kExpected, kAllowed);
  EXPECT_NEAR(mean, -0.5, 1e-3);
}

TEST(Convergence, SlopesOfPowerLawsAreExact) {
  for (const double slope : {-0.5, -1.0, -0.75, 0.0}) {
    const auto method = method_of({power_law(1, slope), power_law(2, slope), power_law(0.5, slope)});
    for (const auto along : {Abscissa::seconds, Abscissa::samples}) {
      const Estimate fit = slope_of(method, along);
      EXPECT_NEAR(fit.value, slope, 1e-9);
      EXPECT_NEAR(fit.standard_error, 0, 1e-9);
      EXPECT_EQ(fit.degrees, 2);
    }
  }
}

TEST(Convergence, SlopeIntervalsOfRenderingsAreCalibrated) {
  std::mt19937 random(2);
  int held = 0;
  double mean = 0;
  for (int run = 0; run < kRuns; ++run) {
    MethodCurves method;
    for (int i = 0; i < 8; ++i) method.repeats.push_back(running_means(random, 64));
    const Estimate slope = slope_of(method, Abscissa::seconds);
    held += std::abs(slope.value + 0.5) <= kStudent7 * slope.standard_error;
    mean += slope.value / kRuns;
  }
  EXPECT_NEAR(held, kExpected, kAllowed);
  EXPECT_NEAR(mean, -0.5, 1e-3);
}

TEST(Convergence, DenselySampledEndsDoNotDominateTheSlope) {
  // Steep at first, then flat, with a thousand points in the flat part.
  const auto bent = [](const std::vector<double>& times) {
    ErrorCurve curve;
    for (const double t : times) curve.points.push_back({t, t, t < 1 ? 1 / t : 1, 0, 0});
    return method_of({curve});
  };
  std::vector<double> crowded = log_grid(0.01, 1, 50);
  for (int i = 1; i <= 1000; ++i) crowded.push_back(1 + 0.099 * i);
  const double even = slope_of(bent(log_grid(0.01, 100, 99)), Abscissa::seconds).value;
  EXPECT_NEAR(slope_of(bent(crowded), Abscissa::seconds).value, even, 0.02);
}

TEST(Convergence, OneRepeatHasNoSpread) {
  std::mt19937 random(3);
  const Estimate slope = slope_of(method_of({running_means(random, 16)}), Abscissa::samples);
  EXPECT_TRUE(slope.known);
  EXPECT_EQ(slope.degrees, 0);
  EXPECT_GT(slope.standard_error, 0);
  EXPECT_FALSE(slope_of(MethodCurves(), Abscissa::samples).known);
}

TEST(Convergence, GridsHaveEqualRatios) {
  const auto grid = log_grid(0.5, 32, 7);
  ASSERT_EQ(grid.size(), 7u);
  for (size_t i = 0; i < 7; ++i) EXPECT_NEAR(grid[i], std::ldexp(0.5, static_cast<int>(i)), 1e-12);
  EXPECT_EQ(grid.back(), 32);
}

TEST(Convergence, PowerLawsAreInterpolatedExactly) {
  const ErrorCurve curve = power_law(3, -0.5, 5);
  for (const double t : {0.1, 0.123, 1.0, 9.99, 10.0}) {
    EXPECT_NEAR(error_at(curve, Abscissa::seconds, film::ErrorMeasure::rmse, t).value_or(0), 3 / std::sqrt(t), 1e-9) << t;
    EXPECT_NEAR(error_at(curve, Abscissa::samples, film::ErrorMeasure::relative, 100 * t).value_or(0), std::sqrt(18 / t), 1e-7) << t;
  }
  EXPECT_FALSE(error_at(curve, Abscissa::seconds, film::ErrorMeasure::rmse, 0.09));
  EXPECT_FALSE(error_at(curve, Abscissa::seconds, film::ErrorMeasure::rmse, 10.1));
}

TEST(Convergence, BandsAreQuantilesOfRepeats) {
  std::vector<ErrorCurve> repeats;
  for (int i = 1; i <= 11; ++i) repeats.push_back(power_law(i, -0.5));
  const auto band = error_band(method_of(repeats), Abscissa::seconds, film::ErrorMeasure::rmse, log_grid(0.2, 5, 9));
  ASSERT_EQ(band.size(), 9u);
  for (const auto& p : band) {
    EXPECT_NEAR(p.median * std::sqrt(p.x), 6, 1e-9);
    EXPECT_NEAR(p.low * std::sqrt(p.x), 2, 1e-9);
    EXPECT_NEAR(p.high * std::sqrt(p.x), 10, 1e-9);
  }
}

// The repeats that end early have twice the error. Their presence must not change any point of the median.
TEST(Convergence, RepeatsThatEndEarlyDoNotBendTheMedian) {
  ErrorCurve brief = power_law(2, -0.5);
  brief.points.resize(6);
  const auto one_of_three = method_of({power_law(1, -0.5), brief, brief});
  EXPECT_EQ(complete_repeats(one_of_three, Abscissa::seconds).repeats.size(), 1u);
  const auto band = error_band(one_of_three, Abscissa::seconds, film::ErrorMeasure::rmse, log_grid(0.1, 10, 12));
  ASSERT_EQ(band.size(), 12u);
  for (const auto& p : band) EXPECT_NEAR(p.median * std::sqrt(p.x), 1, 1e-9) << p.x;
}

// Repeats of equal time end at slightly different sample counts. The band ends where the first of them ends, and the
// end of the curve is its last point.
TEST(Convergence, TheTableAgreesWithTheEndOfTheCurve) {
  std::vector<ErrorCurve> repeats{power_law(1, -0.5), power_law(2, -0.5), power_law(4, -0.5)};
  for (size_t i = 0; i < repeats.size(); ++i) repeats[i].points.back().seconds *= 1 - 0.02 * static_cast<double>(i);
  const auto method = method_of(repeats);
  const auto range = abscissa_range(method, Abscissa::seconds, film::ErrorMeasure::rmse);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->last, repeats[2].points.back().seconds, 1e-12);
  const auto band =
      error_band(method, Abscissa::seconds, film::ErrorMeasure::rmse, log_grid(range->first, range->last, 25));
  ASSERT_EQ(band.size(), 25u);
  const CurveEnd end = curve_end(method, Abscissa::seconds, film::ErrorMeasure::rmse);
  ASSERT_TRUE(end.point);
  EXPECT_EQ(end.repeats, 3u);
  EXPECT_EQ(end.point->x, band.back().x);
  EXPECT_EQ(end.point->median, band.back().median);
  EXPECT_NEAR(end.seconds, repeats[1].points.back().seconds, 1e-12);
}

TEST(Convergence, VarianceOfTheReferenceIsSubtracted) {
  const ReferenceNoise noise{0.04, 0.08};
  MethodCurves measured = method_of({power_law(1, -0.5)});
  for (auto& p : measured.repeats[0].points) {
    p.mse += noise.mse;
    p.relmse += noise.relmse;
  }
  EXPECT_GT(slope_of(measured, Abscissa::seconds).value, -0.48);
  const auto corrected = without_noise(measured, noise);
  EXPECT_NEAR(slope_of(corrected, Abscissa::seconds, noise).value, -0.5, 1e-9);
  EXPECT_NEAR(corrected.repeats[0].points[0].relmse, 20, 1e-9);
}

TEST(Convergence, ANoisyReferenceIsFlagged) {
  // The smallest RMSE is 10^-0.5.
  const auto method = method_of({power_law(1, -0.5)});
  EXPECT_FALSE(is_reference_too_noisy(method, {}));
  // The noise is known exactly: it must be smaller than the error.
  EXPECT_FALSE(is_reference_too_noisy(method, {.mse = 0.099}));
  EXPECT_TRUE(is_reference_too_noisy(method, {.mse = 0.101}));
  // Known to a half: with q = 0.0198, sqrt(q^2 + 2 q) / 4 is 5 %.
  EXPECT_FALSE(is_reference_too_noisy(method, {.mse = 0.1 * 0.0197, .relative_error = 0.5}));
  EXPECT_TRUE(is_reference_too_noisy(method, {.mse = 0.1 * 0.0199, .relative_error = 0.5}));
}

TEST(Convergence, PointsWithoutErrorAreSkipped) {
  MethodCurves method = method_of({power_law(1, -0.5)});
  method.repeats[0].points[3].mse = 0;
  method.repeats[0].points[5].mse = NAN;
  EXPECT_NEAR(slope_of(method, Abscissa::seconds).value, -0.5, 1e-9);
  for (const auto& p : error_band(method, Abscissa::seconds, film::ErrorMeasure::rmse, log_grid(0.1, 10, 40)))
    EXPECT_NEAR(p.median * std::sqrt(p.x), 1, 1e-9);
}

TEST(Convergence, EfficiencyOfMonteCarloIsIndependentOfTime) {
  const Estimate e = efficiency_of(method_of({power_law(0.1, -0.5), power_law(0.1, -0.5, 3)}));
  EXPECT_NEAR(e.value, 100, 1e-9);
  EXPECT_NEAR(e.standard_error, 0, 1e-9);
  // Costs of 1 and 3: the mean is 2 +- 1.
  const Estimate scattered = efficiency_of(method_of({power_law(1, -0.5), power_law(std::sqrt(3.0), -0.5)}));
  EXPECT_NEAR(scattered.value, 0.5, 1e-9);
  EXPECT_NEAR(scattered.standard_error, 0.25, 1e-9);
  EXPECT_FALSE(efficiency_of(method_of({power_law(0, -0.5)})).known);
}

// Eight repeats of 16 pixels with unit variance and a bias of 0.2. The mean of 500 estimates of each part is within 3.3
// of its standard errors, except once in 1000.
TEST(Convergence, BiasAndVarianceAreSeparatedByRepeats) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  constexpr int kRepeats = 8, kPixels = 16;
  std::vector<double> biases, variances;
  for (int run = 0; run < kRuns; ++run) {
    double mean_mse = 0, mse_of_mean = 0;
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      double sum = 0;
      for (int i = 0; i < kRepeats; ++i) {
        const double error = 0.2 + normal(random);
        sum += error;
        mean_mse += error * error / kRepeats / kPixels;
      }
      mse_of_mean += std::pow(sum / kRepeats, 2) / kPixels;
    }
    const auto parts = bias_and_variance(mean_mse, mse_of_mean, kRepeats);
    ASSERT_TRUE(parts);
    biases.push_back(parts->squared_bias);
    variances.push_back(parts->variance);
  }
  const Estimate bias = estimate_of(biases), variance = estimate_of(variances);
  EXPECT_NEAR(bias.value, 0.04, 3.3 * bias.standard_error);
  EXPECT_NEAR(variance.value, 1, 3.3 * variance.standard_error);
  EXPECT_LT(bias.standard_error, 0.01);
  EXPECT_FALSE(bias_and_variance(1, 1, 1));
}

TEST(Convergence, BiasIncludesTheErrorOfTheReference) {
  auto a = power_law(1, -0.5), b = power_law(1, -0.5);
  a.points.back().bias = 0.1;
  b.points.back().bias = 0.3;
  const Estimate bias = bias_of(method_of({a, b}), 0.1);
  EXPECT_NEAR(bias.value, 0.2, 1e-12);
  EXPECT_NEAR(bias.standard_error, std::hypot(0.1, 0.1), 1e-12);
}

TEST(Convergence, QuantilesInterpolateOrderStatistics) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({4, 1}, 0.25), 1.75);
  EXPECT_EQ(quantile({7}, 0.9), 7);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

}  // namespace
}  // namespace etendue::test
