// The interval between redraws limits the share of processor time that drawing takes.
#include "viewer/platform/pacing.h"

#include <gtest/gtest.h>

namespace etendue::pacing_test {
namespace {

using viewer::Pacing;

double settled_interval(double cost, uint32_t samples) {
  Pacing pacing;
  for (int i = 0; i < 30; ++i) pacing.add_redraw(cost);
  return pacing.interval(samples);
}

TEST(Pacing, FastDrawingFollowsTheSampleCount) {
  EXPECT_DOUBLE_EQ(settled_interval(0.001, 1), 0.1);
  EXPECT_DOUBLE_EQ(settled_interval(0.001, 100), 0.25);
  EXPECT_DOUBLE_EQ(settled_interval(0.001, 1000), 0.5);
}

TEST(Pacing, SlowDrawingTakesLessThanATenthOfTheTime) {
  for (const double cost : {0.01, 0.02, 0.04, 0.07}) EXPECT_LT(cost / settled_interval(cost, 1), 0.1) << cost;
  EXPECT_EQ(settled_interval(5, 1), Pacing::kMaxInterval);
}

TEST(Pacing, SingleSlowFrameHasNoLastingEffect) {
  Pacing pacing;
  for (int i = 0; i < 10; ++i) pacing.add_redraw(0.005);
  const double before = pacing.interval(1);
  pacing.add_redraw(0.5);
  EXPECT_GT(pacing.interval(1), before);
  for (int i = 0; i < 10; ++i) pacing.add_redraw(0.005);
  EXPECT_LT(pacing.interval(1), 2 * before);
}

}  // namespace
}  // namespace etendue::pacing_test
