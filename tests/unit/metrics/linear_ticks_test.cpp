// Tick marks of linear axes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "metrics/log_axis.h"

namespace etendue::metrics {
namespace {

// Labels are distinct, and each is within half a thousandth of the distance of ticks from its value.
TEST(LinearTicks, LabelsDistinguishNeighbours) {
  for (const auto& [low, high] :
       {std::pair{0.0, 1.0}, {0.7495, 0.7503}, {-2.0, 3.0}, {1e6, 1e6 + 2}, {-1e-5, 1e-5}, {99990.0, 100010.0}}) {
    const auto ticks = linear_ticks(low, high);
    ASSERT_GE(ticks.size(), 4u) << low;
    const double step = ticks[1].value - ticks[0].value;
    for (size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_NEAR(std::stod(ticks[i].label), ticks[i].value, 5e-4 * step) << low;
    }
    for (size_t i = 1; i < ticks.size(); ++i) EXPECT_NE(ticks[i].label, ticks[i - 1].label);
  }
}

TEST(LinearTicks, AreAtMostOneMoreThanRequested) {
  for (const int most : {1, 2, 3, 5, 9, 20}) {
    const auto ticks = linear_ticks(-0.3, 1.7, most);
    EXPECT_LE(ticks.size(), static_cast<size_t>(most) + 1);
    EXPECT_GE(5 * ticks.size(), static_cast<size_t>(most)) << "steps are at most 2.5 times as long as necessary";
  }
}

TEST(LinearTicks, RoundValuesHaveShortLabels) {
  const auto ticks = linear_ticks(0, 1);
  EXPECT_EQ(ticks.front().label, "0");
  EXPECT_EQ(ticks.back().label, "1");
}

}  // namespace
}  // namespace etendue::metrics
