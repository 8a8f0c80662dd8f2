// Hashed permutations: bijectivity and the distribution of one and of two elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "sampling/permutation.h"

namespace etendue {
namespace {

// Including the largest seeds, for which sums wrap around.
TEST(Permutation, IsABijection) {
  for (const uint32_t n : {1U, 2U, 3U, 9U, 16U, 25U, 311U, 3969U, 4096U})
    for (uint32_t k = 0; k < 40; ++k) {
      std::set<uint32_t> images;
      for (uint32_t i = 0; i < n; ++i) images.insert(permutation_element(i, n, k % 2 ? mix_bits(k) : 0U - k));
      EXPECT_EQ(images.size(), n);
      EXPECT_EQ(*images.rbegin(), n - 1);
    }
}

// Over random seeds each element is uniform: the largest of n deviations is below 5 standard errors (2e-4 false
// alarms).
TEST(Permutation, ElementsAreUniform) {
  constexpr uint32_t kSeeds = 400'000;
  for (const uint32_t n : {2U, 3U, 4U, 9U, 16U, 64U})
    for (const uint32_t i : {0U, n - 1}) {
      std::vector<int> counts(n);
      for (uint32_t s = 0; s < kSeeds; ++s) ++counts[permutation_element(i, n, mix_bits(s + 77))];
      const double expected = static_cast<double>(kSeeds) / n;
      for (const int c : counts) EXPECT_LT(std::abs(c - expected), 5 * std::sqrt(expected)) << n << ' ' << i;
    }
}

// Pairs of elements are uniform up to 10 % root mean square, after subtracting the variance of the counts.
TEST(Permutation, PairsOfElementsAreUniform) {
  constexpr double kPerPair = 200;
  for (const uint32_t n : {3U, 4U, 5U, 9U, 16U, 25U, 64U})
    for (const uint32_t other : {1U, n / 2, n - 1}) {
      const double pairs = static_cast<double>(n) * (n - 1);
      std::vector<int> counts(size_t{n} * n);
      for (uint32_t s = 0; s < kPerPair * pairs; ++s) {
        const uint32_t seed = mix_bits(s + 1234567);
        ++counts[permutation_element(0, n, seed) * n + permutation_element(other, n, seed)];
      }
      double statistic = 0;
      for (uint32_t a = 0; a < n; ++a)
        for (uint32_t b = 0; b < n; ++b)
          if (a != b) statistic += std::pow(counts[a * n + b] - kPerPair, 2) / kPerPair;
      const double deviation = std::sqrt(std::max(statistic / pairs - 1, 0.0) / kPerPair);
      EXPECT_LT(deviation, 0.1) << n << ' ' << other;
    }
}

TEST(Permutation, AllPermutationsOfFourOccur) {
  std::set<std::vector<uint32_t>> permutations;
  for (uint32_t s = 0; s < 2000; ++s) {
    const uint32_t seed = mix_bits(s);
    permutations.insert({permutation_element(0, 4, seed), permutation_element(1, 4, seed),
                         permutation_element(2, 4, seed), permutation_element(3, 4, seed)});
  }
  EXPECT_EQ(permutations.size(), 24U);
}

}  // namespace
}  // namespace etendue
