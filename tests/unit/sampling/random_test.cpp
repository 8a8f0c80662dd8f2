// Independence of the samples of the random sampler.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "unit/sampling/points.h"

namespace etendue {
namespace {

// The mean of n independent samples has 1/n of the variance of one, for any function of the dimensions. For 20,000
// pixels the ratio has a standard error of 1 %; the test allows 5 standard errors (6e-7 false alarms).
TEST(Random, VarianceOfTheMeanIsThatOfIndependentSamples) {
  const auto sampler = make_sampler("random");
  constexpr uint32_t kPixels = 20'000, kSamples = 16;
  double squares = 0;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0;
    for (const auto& p : test::points(*sampler, mix_bits(pixel + 1), kSamples, 2))
      for (const float v : p) mean += (v - 0.5) / kSamples;
    squares += mean * mean;
  }
  const double ideal = 2.0 * kBlockSize / 12 / kSamples;
  EXPECT_NEAR(squares / kPixels / ideal, 1, 0.05);
}

}  // namespace
}  // namespace etendue
