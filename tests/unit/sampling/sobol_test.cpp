// The Sobol' sequence: scrambling and padding preserve its net properties                     [Lang, sec. 7.2.4-7.3.3]
#include <gtest/gtest.h>

#include <set>

#include "base/hash.h"
#include "sampling/sobol.h"
#include "unit/sampling/points.h"

namespace etendue {
namespace {

// 2^m scrambled points have one point in each of 2^m intervals of every dimension.
TEST(Sobol, OneDimensionalProjectionsAreNets) {
  SobolSampler sampler;
  sampler.prepare(0, 64);
  const auto p = test::points(sampler, 12345, 64, 8);
  for (size_t d = 0; d < 64; ++d) {
    std::set<int> cells;
    for (const auto& x : p) cells.insert(static_cast<int>(x[d] * 64));
    EXPECT_EQ(cells.size(), 64U) << "dimension " << d;
  }
}

// Dimensions 1 and 2 form a (0, m, 2)-net: every elementary interval of area 1/64 holds one of 64 points.
TEST(Sobol, FirstTwoDimensionsAreAZeroNet) {
  SobolSampler sampler;
  sampler.prepare(0, 64);
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const auto p = test::points(sampler, seed, 64, 1);
    for (int k = 0; k <= 6; ++k) {
      std::set<std::pair<int, int>> cells;
      for (const auto& x : p)
        cells.insert({static_cast<int>(x[0] * (1 << k)), static_cast<int>(x[1] * (1 << (6 - k)))});
      EXPECT_EQ(cells.size(), 64U) << "seed " << seed << " shape " << k;
    }
  }
}

// Pairs of neighbouring dimensions form (t, m, 2)-nets. For 1024 unscrambled points t is at most 6, and at most 1 for
// 14 of the 63 pairs, as the direction numbers guarantee.
TEST(Sobol, NeighbouringDimensionsAreNets) {
  constexpr uint32_t kLog = 10;
  const auto is_net = [](uint32_t d, uint32_t t) {
    for (uint32_t k = 0; k <= kLog - t; ++k) {
      std::vector<uint32_t> counts(size_t{1} << (kLog - t));
      for (uint32_t i = 0; i < 1U << kLog; ++i) {
        const uint64_t x = SobolSampler::point(i, d), y = SobolSampler::point(i, d + 1);
        ++counts[(x >> (32 - k)) << (kLog - t - k) | y >> (32 - (kLog - t - k))];
      }
      for (const uint32_t n : counts)
        if (n != 1U << t) return false;
    }
    return true;
  };
  int good = 0;
  for (uint32_t d = 0; d + 1 < SobolSampler::kDimensions; ++d) {
    EXPECT_TRUE(is_net(d, 6)) << d;
    good += is_net(d, 1);
  }
  EXPECT_TRUE(is_net(0, 0));
  EXPECT_EQ(good, 14);
}

// Beyond 64 dimensions, each block is a net for every aligned group of samples.
TEST(Sobol, PaddedBlocksAreNets) {
  SobolSampler sampler;
  for (uint32_t seed = 0; seed < 10; ++seed)
    for (const uint32_t first : {0U, 64U, 4096U})
      for (const uint32_t block : {8U, 9U, 100U}) {
        std::vector<SampleBlock> p(64);
        for (uint32_t s = 0; s < 64; ++s) sampler.block(seed, first + s, block, p[s]);
        for (int k = 0; k <= 6; ++k) {
          std::set<std::pair<int, int>> cells;
          for (const auto& x : p)
            cells.insert({static_cast<int>(x[0] * (1 << k)), static_cast<int>(x[1] * (1 << (6 - k)))});
          EXPECT_EQ(cells.size(), 64U) << "seed " << seed << " block " << block << " shape " << k;
        }
        for (size_t d = 0; d < kBlockSize; ++d) {
          std::set<int> cells;
          for (const auto& x : p) cells.insert(static_cast<int>(x[d] * 64));
          EXPECT_EQ(cells.size(), 64U) << "dimension " << d;
        }
      }
}

// Blocks are combined at random: over 64 samples, pairs of blocks are uncorrelated on average.
TEST(Sobol, PaddedBlocksAreIndependent) {
  const SobolSampler sampler;
  constexpr uint32_t kPixels = 500;
  for (const auto& [one, other] : {std::pair{0U, 8U}, {8U, 9U}, {9U, 40U}}) {
    double sum = 0, squares = 0;
    for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
      double correlation = 0;
      for (uint32_t s = 0; s < 64; ++s) {
        SampleBlock a, b;
        sampler.block(mix_bits(pixel + 1), s, one, a);
        sampler.block(mix_bits(pixel + 1), s, other, b);
        for (size_t d = 0; d < kBlockSize; ++d) correlation += (a[d] - 0.5) * (b[d] - 0.5) * 12 / (64 * kBlockSize);
      }
      sum += correlation;
      squares += correlation * correlation;
    }
    EXPECT_LT(std::abs(sum), 4.5 * std::sqrt(squares)) << one << ' ' << other;
  }
}

TEST(Sobol, TabulatedAndComputedValuesAreEqual) {
  SobolSampler tabulated, computed;
  tabulated.prepare(64, 64);
  for (const uint32_t s : {0U, 63U, 64U, 77U, 127U, 128U, 0xffffffffU})
    for (uint32_t b = 0; b < 10; ++b) {
      SampleBlock x, y;
      tabulated.block(9, s, b, x);
      computed.block(9, s, b, y);
      EXPECT_EQ(x, y);
    }
}

// The convergence rate of the RMSE for a smooth integrand over 200 scrambles: -1/2 for random points, below -0.8 for
// Sobol' points.
TEST(Sobol, ConvergesFasterThanRandomNumbers) {
  const auto rmse = [](const char* name, uint32_t n, size_t dimensions) {
    const auto sampler = make_sampler(name);
    double squares = 0;
    constexpr uint32_t kScrambles = 200;
    for (uint32_t r = 0; r < kScrambles; ++r) {
      double mean = 0;
      for (const auto& p : test::points(*sampler, mix_bits(r + 5), n, 1)) {
        double f = 1;
        for (size_t d = 0; d < dimensions; ++d) f *= 1 + 0.5 * std::sin(2 * 3.14159265 * p[d]) * p[d];
        mean += f / n;
      }
      const double exact = std::pow(1 - 0.5 / (2 * 3.14159265), static_cast<double>(dimensions));
      squares += sqr(mean - exact);
    }
    return std::sqrt(squares / kScrambles);
  };
  for (const size_t dimensions : {size_t{2}, size_t{4}}) {
    const auto slope = [&](const char* name) {
      return std::log(rmse(name, 512, dimensions) / rmse(name, 16, dimensions)) / std::log(512.0 / 16);
    };
    EXPECT_LT(slope("sobol"), -0.8) << dimensions;
    EXPECT_NEAR(slope("random"), -0.5, 0.08) << dimensions;
  }
}

}  // namespace
}  // namespace etendue
