// Pearson's test: the survival function in closed form, pooling of small cells, and its rejection of wrong expectations.
// Random numbers: uniform, and independent for different seeds.
#include "equations/pearson_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "equations/random_numbers.h"

namespace etendue::equations {
namespace {

TEST(PearsonTest, SurvivalFunctionHasClosedForms) {
  for (const double x : {0.1, 1.0, 4.0, 20.0}) {
    EXPECT_NEAR(chi_square_survival(x, 1), std::erfc(std::sqrt(x / 2)), 1e-14) << x;
    EXPECT_NEAR(chi_square_survival(x, 2), std::exp(-x / 2), 1e-14) << x;
    EXPECT_NEAR(chi_square_survival(x, 4), std::exp(-x / 2) * (1 + x / 2), 1e-14) << x;
  }
  EXPECT_EQ(chi_square_survival(0, 5), 1);
}

TEST(PearsonTest, SmallCellsAreCountedTogether) {
  const std::vector<double> counts{10, 12, 3, 2, 0}, expected{11, 11, 2, 2, 2};
  const ChiSquareTest test = chi_square_test(counts, expected);
  EXPECT_EQ(test.degrees, 2);
  EXPECT_NEAR(test.statistic, 2.0 / 11 + 1.0 / 6, 1e-14);
}

// A single count where a hundredth is expected says nothing.
TEST(PearsonTest, FewCountsJoinTheSmallestCell) {
  const std::vector<double> counts{20, 12, 1}, expected{21, 11.99, 0.01};
  const ChiSquareTest test = chi_square_test(counts, expected);
  EXPECT_EQ(test.degrees, 1);
  EXPECT_NEAR(test.statistic, 1.0 / 21 + 1.0 / 12, 1e-13);
}

TEST(PearsonTest, CountsWhereThereShouldBeNoneAreImpossible) {
  const std::vector<double> counts{10, 10, 1}, expected{10, 10, 0};
  EXPECT_EQ(chi_square_test(counts, expected).p_value, 0);
}

// False-alarm rate 1e-4 for a fixed seed.
TEST(RandomNumbers, AreUniformInPairs) {
  constexpr int kCells = 20, kSamples = 200000;
  std::vector<double> counts(kCells * kCells, 0.0);
  const std::vector<double> expected(counts.size(), static_cast<double>(kSamples) / static_cast<double>(counts.size()));
  RandomNumbers random(7);
  for (int i = 0; i < kSamples; ++i) {
    const int x = static_cast<int>(kCells * random.uniform());
    const int y = static_cast<int>(kCells * random.uniform());
    counts[static_cast<size_t>(x * kCells + y)] += 1;
  }
  EXPECT_GT(chi_square_test(counts, expected).p_value, 1e-4);
}

TEST(RandomNumbers, OfNeighbouringSeedsAreUncorrelated) {
  constexpr int kSeeds = 20000;
  double sum = 0;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    RandomNumbers a(seed), b(seed + 1);
    sum += (a.uniform() - 0.5) * (b.uniform() - 0.5);
  }
  // The products have the standard deviation 1/12; 4.5 standard errors.
  EXPECT_NEAR(sum / kSeeds, 0, 4.5 / 12 / std::sqrt(kSeeds));
}

}  // namespace
}  // namespace etendue::equations
