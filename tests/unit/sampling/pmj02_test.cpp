// Progressive multi-jittered (0,2) sequences: stratification of every decision, and errors of integrals
#include "sampling/pmj02.h"

#include <gtest/gtest.h>

#include <set>

#include "base/hash.h"
#include "patterns/net_quality.h"
#include "unit/sampling/points.h"

namespace etendue {
namespace {

constexpr uint32_t kLateBlock = 100;

// Dimensions `dimension` and dimension + 1 of the samples [first, first + count) in a block.
std::vector<patterns::PlanePoint> pairs(uint32_t seed, uint32_t block, uint32_t first, uint32_t count,
                                        size_t dimension) {
  const Pmj02Sampler sampler;
  std::vector<patterns::PlanePoint> result;
  for (uint32_t s = first; s < first + count; ++s) {
    SampleBlock values;
    sampler.block(seed, s, block, values);
    result.push_back({values[dimension], values[dimension + 1]});
  }
  return result;
}

TEST(Pmj02, EveryDecisionIsANet) {
  for (uint32_t seed = 0; seed < 10; ++seed)
    for (const uint32_t block : {0U, 3U, kLateBlock})
      for (const uint32_t first : {0U, 64U, 4096U})
        for (const size_t dimension : {size_t{0}, size_t{2}})
          EXPECT_EQ(patterns::net_quality(pairs(mix_bits(seed), block, first, 64, dimension), 2), 0);
}

TEST(Pmj02, EveryDimensionIsStratified) {
  const Pmj02Sampler sampler;
  for (const uint32_t block : {0U, kLateBlock})
    for (size_t d = 0; d < kBlockSize; ++d) {
      std::set<int> filled;
      for (uint32_t s = 128; s < 256; ++s) {
        SampleBlock values;
        sampler.block(77, s, block, values);
        filled.insert(static_cast<int>(values[d] * 128));
      }
      EXPECT_EQ(filled.size(), 128U) << d;
    }
}

// Positions within the cells of the net are random: the offsets from the cells' corners have the moments of the uniform
// distribution. The bounds are 4.5 standard errors.
TEST(Pmj02, PointsAreJittered) {
  constexpr uint32_t kSeeds = 500, kPoints = 64;
  constexpr double kCount = double{kSeeds} * kPoints;
  std::array<double, 2> mean{}, square{};
  for (uint32_t seed = 0; seed < kSeeds; ++seed)
    for (const auto& p : pairs(mix_bits(seed + 1), 5, 0, kPoints, 2))
      for (const size_t axis : {size_t{0}, size_t{1}}) {
        const double offset = p[axis] * kPoints - std::floor(p[axis] * kPoints);
        mean[axis] += offset / kCount;
        square[axis] += offset * offset / kCount;
      }
  for (const size_t axis : {size_t{0}, size_t{1}}) {
    EXPECT_NEAR(mean[axis], 0.5, 4.5 * std::sqrt(1 / (12 * kCount)));
    EXPECT_NEAR(square[axis], 1.0 / 3, 4.5 * std::sqrt(4 / (45 * kCount)));
  }
}

// Different decisions are combined at random: correlations over 64 samples vanish on average.
TEST(Pmj02, DecisionsAreIndependent) {
  const Pmj02Sampler sampler;
  constexpr uint32_t kPixels = 500;
  for (const auto& [one, other] : {std::pair{0, 2}, {0, 4}, {3, 5}, {6, 7}}) {
    double sum = 0, squares = 0;
    for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
      double correlation = 0;
      for (uint32_t s = 0; s < 64; ++s) {
        SampleBlock values;
        sampler.block(mix_bits(pixel + 1), s, 2, values);
        correlation += (values[static_cast<size_t>(one)] - 0.5) * (values[static_cast<size_t>(other)] - 0.5) * 12 / 64;
      }
      sum += correlation;
      squares += correlation * correlation;
    }
    EXPECT_LT(std::abs(sum), 4.5 * std::sqrt(squares)) << one << ' ' << other;
    // Random orders give 1 / 64. Two progressive orders agree or disagree for each pair of successive samples as a whole,
    // which at most doubles the variance.
    EXPECT_LT(squares / kPixels, 2.0 / 64) << one << ' ' << other;
  }
}

TEST(Pmj02, ManyPixelsGetTheSameValuesAsOne) {
  const Pmj02Sampler sampler;
  std::vector<uint32_t> seeds;
  for (uint32_t i = 0; i < 100; ++i) seeds.push_back(mix_bits(i));
  SampleTable table;
  for (const uint32_t sample : {0U, 77U, 0xffffffffU}) {
    ASSERT_EQ(sampler.blocks(seeds, sample, 3, 0xff, table), 0xffU);
    for (size_t i = 0; i < seeds.size(); ++i) {
      SampleBlock values;
      sampler.block(seeds[i], sample, 3, values);
      for (size_t k = 0; k < kBlockSize; ++k) EXPECT_EQ(table.values[k][i], values[k]);
    }
  }
}

// The RMSE of a smooth integral over a decision falls as N^-1.5, that of random numbers as N^-0.5.
TEST(Pmj02, ConvergesAsNetsDo) {
  const auto rmse = [](uint32_t count) {
    const double exact = std::pow(std::exp(1.0) - 1, 2);
    constexpr uint32_t kSets = 1000;
    double squares = 0;
    for (uint32_t seed = 0; seed < kSets; ++seed) {
      double sum = 0;
      for (const auto& p : pairs(mix_bits(seed + 1), 1, 0, count, 2)) sum += std::exp(p[0] + p[1]);
      squares += std::pow(sum / count - exact, 2);
    }
    return std::sqrt(squares / kSets);
  };
  EXPECT_NEAR(std::log(rmse(1024) / rmse(64)) / std::log(16.0), -1.45, 0.1);
}

}  // namespace
}  // namespace etendue
