// Estimates of the time to a target error, for exact error curves and for renderings.
#include "render/time_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etendue::render {
namespace {

film::ErrorEstimate estimate(double rmse, double relative) {
  film::ErrorEstimate e;
  e.rmse = rmse;
  e.rmse_interval = {rmse * (1 - relative), rmse / (1 - relative)};
  e.known = true;
  return e;
}

TimeEstimator with_slope(double slope, double relative) {
  TimeEstimator forecast;
  for (uint32_t n = 2; n <= 256; n *= 2) forecast.add(n, 0.01 * n, estimate(std::pow(n, slope), relative));
  return forecast;
}

TEST(TimeEstimator, FollowsAKnownCurve) {
  // Half the error needs four times the samples: 7.68 more seconds.
  const auto random = with_slope(-0.5, 0.01).time_to(std::pow(256, -0.5) / 2, 2.56);
  ASSERT_TRUE(random);
  EXPECT_NEAR(random->seconds, 7.68, 0.01 * 7.68);
  EXPECT_LT(random->interval.low, random->seconds);
  EXPECT_GT(random->interval.high, random->seconds);
  // A steep slope is used with a weight below one: 2^(1/0.75) = 2.52 times the samples.
  const auto steep = with_slope(-0.75, 0.001).time_to(std::pow(256, -0.75) / 2, 2.56);
  ASSERT_TRUE(steep);
  EXPECT_NEAR(steep->seconds, 1.52 * 2.56, 0.2 * 1.52 * 2.56);
}

TEST(TimeEstimator, IntervalIsWiderForUncertainErrors) {
  const double target = std::pow(256, -0.5) / 4;
  const auto sure = with_slope(-0.5, 0.01).time_to(target, 2.56), vague = with_slope(-0.5, 0.4).time_to(target, 2.56);
  ASSERT_TRUE(sure && vague);
  EXPECT_GT(vague->interval.high - vague->interval.low, 1.5 * (sure->interval.high - sure->interval.low));
}

TEST(TimeEstimator, IsUnknownBeforeTheFirstError) {
  TimeEstimator forecast;
  EXPECT_FALSE(forecast.time_to(0.1, 0));
  forecast.add(1, 0.1, film::MeasuredError{});
  EXPECT_FALSE(forecast.time_to(0.1, 0.1));
}

TEST(TimeEstimator, IsZeroOnceTheErrorIsReached) {
  const auto there = with_slope(-0.5, 0.1).time_to(0.5, 2.56);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->seconds, 0);
  EXPECT_EQ(there->interval.high, 0);
}

}  // namespace
}  // namespace etendue::render
