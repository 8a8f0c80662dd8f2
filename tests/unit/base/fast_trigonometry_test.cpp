// Polynomials for trigonometric functions against the standard library in double precision.
#include "base/fast_trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etendue {
namespace {

constexpr double kBound = 5e-7;  // radians

TEST(FastTrigonometry, CosineAndSineOfTurnsAreAccurate) {
  constexpr int kSteps = 200'000;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const float turns = 3.25f * static_cast<float>(i) / kSteps;
    const Vec2 d = cos_sin_of_turns(turns);
    ASSERT_NEAR(d.x, std::cos(2 * M_PI * static_cast<double>(turns)), 2e-7) << turns;
    ASSERT_NEAR(d.y, std::sin(2 * M_PI * static_cast<double>(turns)), 2e-7) << turns;
  }
}

TEST(FastTrigonometry, QuarterTurnsAreExact) {
  EXPECT_EQ(cos_sin_of_turns(0), Vec2(1, 0));
  EXPECT_EQ(cos_sin_of_turns(0.25f), Vec2(0, 1));
  EXPECT_EQ(cos_sin_of_turns(0.5f), Vec2(-1, 0));
  EXPECT_EQ(cos_sin_of_turns(-0.25f), Vec2(0, -1));
  EXPECT_EQ(cos_sin_of_turns(7.75f), Vec2(0, -1));
}

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
