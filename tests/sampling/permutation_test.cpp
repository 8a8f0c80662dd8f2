// Permutations by hashing are permutations, and random enough for variances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "sampling/permutation.h"

namespace etendue {
namespace {

// Also for the largest seeds, where a sum with them would wrap.
TEST(Permutation, EveryImageIsTakenOnce) {
  for (const uint32_t n : {1U, 2U, 3U, 9U, 16U, 25U, 311U, 3969U, 4096U})
    for (uint32_t k = 0; k < 40; ++k) {
      std::set<uint32_t> images;
      for (uint32_t i = 0; i < n; ++i) images.insert(permuted(i, n, k % 2 ? mix_bits(k) : 0U - k));
      EXPECT_EQ(images.size(), n);
      EXPECT_EQ(*images.rbegin(), n - 1);
    }
}

// Over many seeds each image is equally likely: the largest of n deviations stays below 5 standard errors (2e-4 false
// alarms).
TEST(Permutation, SingleImagesAreUniform) {
  constexpr uint32_t kSeeds = 400'000;
  for (const uint32_t n : {2U, 3U, 4U, 9U, 16U, 64U})
    for (const uint32_t i : {0U, n - 1}) {
      std::vector<int> counts(n);
      for (uint32_t s = 0; s < kSeeds; ++s) ++counts[permuted(i, n, mix_bits(s + 77))];
      const double expected = static_cast<double>(kSeeds) / n;
      for (const int c : counts) EXPECT_LT(std::abs(c - expected), 5 * std::sqrt(expected)) << n << ' ' << i;
    }
}

// The images of two numbers: uniform among pairs within 10 % root mean square, beyond what counting explains.
TEST(Permutation, PairsOfImagesAreUniform) {
  constexpr double kPerPair = 200;
  for (const uint32_t n : {3U, 4U, 5U, 9U, 16U, 25U, 64U})
    for (const uint32_t other : {1U, n / 2, n - 1}) {
      const double pairs = static_cast<double>(n) * (n - 1);
      std::vector<int> counts(size_t{n} * n);
      for (uint32_t s = 0; s < kPerPair * pairs; ++s) {
        const uint32_t seed = mix_bits(s + 1234567);
        ++counts[permuted(0, n, seed) * n + permuted(other, n, seed)];
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
  std::set<std::vector<uint32_t>> found;
  for (uint32_t s = 0; s < 2000; ++s) {
    const uint32_t seed = mix_bits(s);
    found.insert({permuted(0, 4, seed), permuted(1, 4, seed), permuted(2, 4, seed), permuted(3, 4, seed)});
  }
  EXPECT_EQ(found.size(), 24U);
}

}  // namespace
}  // namespace etendue
