// The Halton sequence: exact radical inverses, stratification and nested scrambling   [Lang, eq. 7.31-7.39, table 7.1]
#include <gtest/gtest.h>

#include <set>

#include "sampling/halton.h"

namespace etendue {
namespace {

// Exact fractions; the first six of bases 2 and 3 are those of [Lang, table 7.1].
TEST(Halton, RadicalInversesAreExact) {
  const auto expect = [](uint32_t base, const std::vector<double>& fractions) {
    for (uint32_t i = 0; i < fractions.size(); ++i)
      EXPECT_DOUBLE_EQ(HaltonSampler::radical_inverse(i, base), fractions[i]) << base << ' ' << i;
  };
  expect(2, {0, 1. / 2, 1. / 4, 3. / 4, 1. / 8, 5. / 8, 3. / 8, 7. / 8, 1. / 16, 9. / 16, 5. / 16, 13. / 16});
  expect(3, {0, 1. / 3, 2. / 3, 1. / 9, 4. / 9, 7. / 9, 2. / 9, 5. / 9, 8. / 9, 1. / 27, 10. / 27, 19. / 27});
  expect(5, {0, 1. / 5, 2. / 5, 3. / 5, 4. / 5, 1. / 25, 6. / 25, 11. / 25, 16. / 25, 21. / 25, 2. / 25, 7. / 25});
  const std::pair<uint32_t, double> far[] = {{2, 0.8805432319641113},
                                             {3, 0.4258453274524673},
                                             {5, 0.537652736},
                                             {7, 0.741149087366589},
                                             {11, 0.36839657228850714}};
  for (const auto& [base, value] : far) EXPECT_DOUBLE_EQ(HaltonSampler::radical_inverse(1234567, base), value) << base;
  EXPECT_LT(HaltonSampler::radical_inverse(0xffffffff, 2), 1);
}

// Any b^k successive samples have one point in each of b^k intervals of a dimension with base b: the first eight
// dimensions with up to 1000 intervals, and two later ones. A point may lie on the lower bound of its interval, where
// rounding to float subtracts up to 2^-25; the test adds this back.
TEST(Halton, DigitsAreStratified) {
  const HaltonSampler sampler;
  constexpr uint32_t kBases[] = {2, 3, 5, 7, 11, 13, 17, 19};
  const auto cells = [&](uint32_t dimension, uint32_t first, uint32_t count) {
    std::set<int> filled;
    for (uint32_t s = first; s < first + count; ++s) {
      SampleBlock values;
      sampler.block(4, s, dimension / kBlockSize, values);
      filled.insert(static_cast<int>(double{values[dimension % kBlockSize]} * count + 0x1p-25 * count));
    }
    return filled.size();
  };
  for (const uint32_t first : {0U, 19U, 1000U}) {
    for (uint32_t d = 0; d < 8; ++d)
      for (uint32_t count = kBases[d]; count <= 1000; count *= kBases[d])
        EXPECT_EQ(cells(d, first, count), count) << "base " << kBases[d];
    EXPECT_EQ(cells(63, first, 311), 311U);
    EXPECT_EQ(cells(24, first, 97), 97U);
  }
}

// The permutation of a digit depends on the digits before it, and not on those after it.
TEST(Halton, ScramblingIsNested) {
  const HaltonSampler sampler;
  const auto digits = [&](uint32_t sample) {  // the first two digits in base 3
    SampleBlock values;
    sampler.block(8, sample, 0, values);
    const auto nine = static_cast<int>(double{values[1]} * 9 + 1e-4);
    return std::pair(nine / 3, nine % 3);
  };
  for (uint32_t s = 0; s < 9; ++s) {
    EXPECT_EQ(digits(s).first, digits(s % 3).first);
    EXPECT_EQ(digits(s), digits(s + 9 * (s + 5)));
  }
  std::set<std::vector<int>> permutations;
  for (uint32_t first = 0; first < 3; ++first)
    permutations.insert({digits(first).second, digits(first + 3).second, digits(first + 6).second});
  EXPECT_GT(permutations.size(), 1U);
}

}  // namespace
}  // namespace etendue
