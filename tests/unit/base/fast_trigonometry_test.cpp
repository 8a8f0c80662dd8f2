// Polynomials for inverse trigonometric functions against the standard library in double precision.
#include "base/fast_trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etendue {
namespace {

constexpr double kBound = 5e-7;  // radians

TEST(FastTrigonometry, AcosIsAccurate) {
  constexpr int kSteps = 200'000;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const float x = static_cast<float>(i) / kSteps;
    ASSERT_NEAR(fast_acos(x), std::acos(static_cast<double>(x)), kBound) << x;
  }
  EXPECT_EQ(fast_acos(1), 0);
  EXPECT_EQ(fast_acos(1.0000001f), 0);
  EXPECT_NEAR(fast_acos(-1.0000001f), kPi, kBound);
}

TEST(FastTrigonometry, Atan2IsAccurate) {
  constexpr int kSteps = 200'000;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = -M_PI + 2 * M_PI * i / kSteps;
    for (const double length : {1e-20, 1.0, 1e15}) {
      const auto x = static_cast<float>(length * std::cos(angle)), y = static_cast<float>(length * std::sin(angle));
      ASSERT_NEAR(fast_atan2(y, x), std::atan2(static_cast<double>(y), static_cast<double>(x)), kBound)
          << x << ' ' << y;
    }
  }
}

TEST(FastTrigonometry, Atan2OfTheAxesIsExact) {
  EXPECT_EQ(fast_atan2(0, 0), 0);
  EXPECT_EQ(fast_atan2(0, 2), 0);
  EXPECT_EQ(fast_atan2(3, 0), 0.5f * kPi);
  EXPECT_EQ(fast_atan2(-3, 0), -0.5f * kPi);
  EXPECT_EQ(fast_atan2(0.0f, -1), kPi);
  EXPECT_EQ(fast_atan2(-0.0f, -1), -kPi);
}

}  // namespace
}  // namespace etendue
