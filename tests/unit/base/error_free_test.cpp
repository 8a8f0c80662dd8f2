// Error-free sums: correct rounding, and independence of the order of terms.
#include "base/error_free.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace etendue {
namespace {

TEST(ErrorFree, SumAndErrorAreExact) {
  double sum = 1;
  EXPECT_EQ(add_exactly(sum, 0x1p-60), 0x1p-60);
  EXPECT_EQ(sum, 1);
  EXPECT_EQ(add_exactly(sum, 0.5), 0);
  EXPECT_EQ(sum, 1.5);
}

// Half a unit in the last place rounds to even, and anything beyond it away from there.
TEST(ErrorFree, RoundsOnce) {
  const auto rounded = [](std::vector<double> terms) { return rounded_sum(terms); };
  const double above = std::nextafter(1.0, 2.0);
  EXPECT_EQ(rounded({}), 0);
  EXPECT_EQ(rounded({1e100, 1, -1e100}), 1);
  EXPECT_EQ(rounded({1, 0x1p-53}), 1);
  EXPECT_EQ(rounded({1, 0x1p-53, 0x1p-200}), above);
  EXPECT_EQ(rounded({0x1p-200, 0x1p-53, 1}), above);
  EXPECT_EQ(rounded({above, 0x1p-53, -0x1p-200}), above);
  EXPECT_EQ(rounded({1, 0x1p-53, -0x1p-200}), 1);
  EXPECT_EQ(rounded({-1, -0x1p-53, -0x1p-200}), -above);
}

// Terms over 240 binary orders of magnitude. A sum in sequence depends on their order.
TEST(ErrorFree, DoesNotDependOnTheOrder) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-120, 120);
  int differing_plain_sums = 0;
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::vector<double> terms;
    for (int i = 0; i < 40; ++i) terms.push_back(std::ldexp(mantissa(engine), static_cast<int>(exponent(engine))));
    const auto plain_sum = [&] {
      double sum = 0;
      for (const double t : terms) sum += t;
      return sum;
    };
    const double sum = rounded_sum(terms), plain = plain_sum();
    const auto expansion = expansion_of(terms);
    ASSERT_FALSE(expansion.empty());
    EXPECT_EQ(expansion[0], sum);
    std::ranges::shuffle(terms, engine);
    EXPECT_EQ(rounded_sum(terms), sum);
    EXPECT_EQ(expansion_of(terms), expansion);
    differing_plain_sums += plain_sum() != plain ? 1 : 0;
    for (const double component : expansion) terms.push_back(-component);
    EXPECT_EQ(rounded_sum(terms), 0);
  }
  EXPECT_GT(differing_plain_sums, 25);
}

// Integers whose exact sum fits into 64 bits, which is rounded to the nearest double, ties to even.
TEST(ErrorFree, IsTheRoundedSumOfIntegers) {
  std::mt19937_64 engine(5);
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::vector<double> terms;
    int64_t exact = 0;
    for (int i = 0; i < 500; ++i) {
      const auto term = static_cast<int64_t>(engine() >> 11) - (int64_t{1} << 51);
      terms.push_back(static_cast<double>(term));
      exact += term;
    }
    EXPECT_EQ(rounded_sum(terms), static_cast<double>(exact));
  }
}

}  // namespace
}  // namespace etendue
