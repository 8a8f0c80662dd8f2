// Exact summation: correct rounding, and independence of order and grouping.
#include "base/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <random>
#include <vector>

namespace etendue {
namespace {

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double x : terms) sum.add(x);
  return sum.value();
}

TEST(ExactSum, OfOneTermIsTheTerm) {
  for (const double x :
       {0.0, 1.0, -1.0, 0.1, -3e-300, DBL_MAX, -DBL_MAX, DBL_MIN, DBL_TRUE_MIN, -5 * DBL_TRUE_MIN, 1e100})
    EXPECT_EQ(sum_of({x}), x);
}

TEST(ExactSum, HasNoCancellationOrOverflow) {
  EXPECT_EQ(sum_of({1e300, 1, -1e300}), 1);
  EXPECT_EQ(sum_of({1, DBL_TRUE_MIN, -1}), DBL_TRUE_MIN);
  EXPECT_EQ(sum_of({DBL_MAX, DBL_MAX, -DBL_MAX}), DBL_MAX);
  EXPECT_EQ(sum_of(std::vector<double>(1000, 0.125)), 125);
}

TEST(ExactSum, DoesNotDependOnOrderAndGrouping) {
  std::mt19937_64 random(3);
  std::vector<double> terms;
  for (int i = 0; i < 2000; ++i) {
    const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
    terms.push_back((unit - 0.3) * std::exp2(static_cast<double>(random() % 200) - 100));
  }
  const double expected = sum_of(terms);
  for (int round = 0; round < 20; ++round) {
    std::shuffle(terms.begin(), terms.end(), random);
    ExactSum parts[7], whole;
    for (size_t i = 0; i < terms.size(); ++i) parts[i * i % 7].add(terms[i]);
    for (const auto& part : parts) whole.add(part);
    EXPECT_EQ(std::bit_cast<uint64_t>(whole.value()), std::bit_cast<uint64_t>(expected));
  }
}

TEST(ExactSum, IsWithinOneUnitInTheLastPlace) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 200; ++round) {
    // The terms are integers, whose exact sum fits into 64 bits.
    ExactSum sum;
    int64_t exact = 0;
    for (int i = 0; i < 50; ++i) {
      const auto term = static_cast<int64_t>(random() >> 12) - (int64_t{1} << 51);
      sum.add(static_cast<double>(term));
      exact += term;
    }
    const auto nearest = static_cast<double>(exact);
    EXPECT_NEAR(sum.value(), nearest, std::nextafter(std::abs(nearest), INFINITY) - std::abs(nearest));
  }
}

}  // namespace
}  // namespace etendue
