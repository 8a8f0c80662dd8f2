// Samplers: nets stay nets under scrambling, strata are filled, streams are independent and repeatable.   digest
// 6-7: 2.6, 2.7
#include <gtest/gtest.h>

#include <set>

#include "base/hash.h"
#include "sampling/halton.h"
#include "sampling/sampler.h"
#include "sampling/sobol.h"
#include "support/chi_square.h"

namespace etendue {
namespace {

std::vector<std::vector<float>> points(const Sampler& sampler, uint32_t seed, uint32_t count, uint32_t blocks) {
  std::vector<std::vector<float>> all(count);
  for (uint32_t s = 0; s < count; ++s)
    for (uint32_t b = 0; b < blocks; ++b) {
      SampleBlock values;
      sampler.block(seed, s, b, values);
      all[s].insert(all[s].end(), values.begin(), values.end());
    }
  return all;
}

class EverySampler : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    sampler_ = make_sampler(GetParam());
    sampler_->prepare(0, 128);
  }
  std::unique_ptr<Sampler> sampler_;
};

TEST_P(EverySampler, ValuesAreInTheUnitIntervalAndRepeatable) {
  for (uint32_t seed : {0U, 1U, 0xffffffffU}) {
    const auto a = points(*sampler_, seed, 300, 12);
    EXPECT_EQ(a, points(*sampler_, seed, 300, 12));
    for (const auto& p : a)
      for (const float v : p) ASSERT_TRUE(v >= 0 && v < 1) << v;
  }
}

// Sixteen bins over many pixels, each dimension alone: 1 % false alarms for all of them together.
TEST_P(EverySampler, EachDimensionIsUniform) {
  constexpr int kBins = 16, kPixels = 4096, kDimensions = 96;
  const double significance = 1 - std::pow(0.99, 1.0 / kDimensions);
  std::vector<std::array<int, kBins>> counts(kDimensions);
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    const auto p = points(*sampler_, mix_bits(pixel + 17), 1, kDimensions / kBlockSize);
    for (size_t d = 0; d < kDimensions; ++d) ++counts[d][static_cast<size_t>(p[0][d] * kBins)];
  }
  for (size_t d = 0; d < kDimensions; ++d) {
    double statistic = 0;
    for (const int n : counts[d]) statistic += sqr(n - double{kPixels} / kBins) / (double{kPixels} / kBins);
    EXPECT_GT(test::chi_square_tail(statistic, kBins - 1), significance) << "dimension " << d;
  }
}

// The first samples of pairs of dimensions over many pixels: uncorrelated within 4.5 standard errors (3e-5 false alarms
// over all pairs). This is what seeds in arithmetic progression break.
TEST_P(EverySampler, DimensionsAndPixelsAreIndependent) {
  constexpr uint32_t kPixels = 20'000;
  std::vector<std::vector<float>> first;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) first.push_back(points(*sampler_, mix_bits(pixel + 1), 1, 2)[0]);
  const auto correlation = [&](size_t a, size_t b, uint32_t shift) {
    double sum = 0;
    for (uint32_t i = 0; i < kPixels; ++i) sum += (first[i][a] - 0.5) * (first[(i + shift) % kPixels][b] - 0.5) * 12;
    return sum / kPixels;
  };
  const double bound = 4.5 / std::sqrt(kPixels);
  for (size_t a = 0; a < 16; ++a) {
    for (size_t b = a + 1; b < 16; ++b) EXPECT_LT(std::abs(correlation(a, b, 0)), bound) << a << ' ' << b;
    EXPECT_LT(std::abs(correlation(a, a, 1)), bound) << a;
  }
}

// Numbers of one pixel, dimensions and samples apart: no dimension of a sample is one of a later sample's, nor
// correlated with it, over many pixels. A bound of 5 standard errors: 1e-3 false alarms over all of them and the four
// samplers.
TEST_P(EverySampler, SamplesOfAPixelShareNoNumbers) {
  constexpr uint32_t kPixels = 10'000, kSamples = 4;
  constexpr size_t kDimensions = 16;
  std::array<std::array<std::array<double, kDimensions>, kDimensions>, kSamples> sums{};
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    const auto p = points(*sampler_, mix_bits(pixel + 99), kSamples, 2);
    for (size_t lag = 1; lag < kSamples; ++lag)
      for (size_t a = 0; a < kDimensions; ++a)
        for (size_t b = 0; b < kDimensions; ++b)
          if (a != b) sums[lag][a][b] += (p[0][a] - 0.5) * (p[lag][b] - 0.5) * 12;
  }
  const double bound = 5 * std::sqrt(kPixels);
  for (size_t lag = 1; lag < kSamples; ++lag)
    for (size_t a = 0; a < kDimensions; ++a)
      for (size_t b = 0; b < kDimensions; ++b)
        EXPECT_LT(std::abs(sums[lag][a][b]), bound) << lag << ' ' << a << ' ' << b;
}

// The mean over pixels of a product over two vertices: what a path integral is made of. z-test, 1 % over the samplers.
TEST_P(EverySampler, ProductsOverManyDimensionsAreUnbiased) {
  constexpr int kPixels = 2000;
  double sum = 0, squares = 0;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0;
    for (const auto& p : points(*sampler_, mix_bits(pixel * 7 + 3), 16, 2)) {
      double product = 1;
      for (const float v : p) product *= 0.5 + v;
      mean += product / 16;
    }
    sum += mean, squares += mean * mean;
  }
  const double mean = sum / kPixels, error = std::sqrt((squares / kPixels - mean * mean) / kPixels);
  EXPECT_LT(std::abs(mean - 1), 3.1 * error) << mean << " +- " << error;
}

INSTANTIATE_TEST_SUITE_P(Samplers, EverySampler, testing::Values("sobol", "halton", "stratified", "random"),
                         [](const auto& instance) { return instance.param; });

// 2^m points of every dimension fall one into each of 2^m intervals, scrambled.
TEST(Sobol, OneDimensionalProjectionsAreNets) {
  SobolSampler sampler;
  sampler.prepare(0, 64);
  const auto p = points(sampler, 12345, 64, 8);
  for (size_t d = 0; d < 64; ++d) {
    std::set<int> cells;
    for (const auto& x : p) cells.insert(static_cast<int>(x[d] * 64));
    EXPECT_EQ(cells.size(), 64U) << "dimension " << d;
  }
}

// Dimensions 1 and 2 form a (0, m, 2)-net: every elementary interval of area 1/64 holds one of 64 points.
TEST(Sobol, TheFirstTwoDimensionsAreAZeroNet) {
  SobolSampler sampler;
  sampler.prepare(0, 64);
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const auto p = points(sampler, seed, 64, 1);
    for (int k = 0; k <= 6; ++k) {
      std::set<std::pair<int, int>> cells;
      for (const auto& x : p)
        cells.insert({static_cast<int>(x[0] * (1 << k)), static_cast<int>(x[1] * (1 << (6 - k)))});
      EXPECT_EQ(cells.size(), 64U) << "seed " << seed << " shape " << k;
    }
  }
}

TEST(Sobol, TableAndDirectionNumbersGiveTheSameValues) {
  SobolSampler with, without;
  with.prepare(64, 64);
  for (const uint32_t s : {64U, 77U, 127U})
    for (uint32_t b = 0; b < 10; ++b) {
      SampleBlock x, y;
      with.block(9, s, b, x);
      without.block(9, s, b, y);
      EXPECT_EQ(x, y);
    }
}

TEST(Halton, RadicalInverses) {
  EXPECT_DOUBLE_EQ(HaltonSampler::radical_inverse(6, 2), 0.375);
  EXPECT_DOUBLE_EQ(HaltonSampler::radical_inverse(5, 3), 2.0 / 3 + 1.0 / 9);
  EXPECT_EQ(HaltonSampler::radical_inverse(0, 7), 0);
}

// Any b successive samples fill the b intervals of a dimension with base b, scrambled.
TEST(Halton, DigitsAreStratified) {
  const HaltonSampler sampler;
  constexpr uint32_t kBases[] = {2, 3, 5, 7, 11, 13, 17, 19};
  for (const uint32_t first : {0U, 19U, 1000U})
    for (size_t d = 0; d < 8; ++d) {
      std::set<int> cells;
      for (uint32_t s = first / kBases[d] * kBases[d], i = 0; i < kBases[d]; ++i) {
        SampleBlock values;
        sampler.block(4, s + i, 0, values);
        cells.insert(static_cast<int>(values[d] * static_cast<float>(kBases[d])));
      }
      EXPECT_EQ(cells.size(), kBases[d]) << "base " << kBases[d];
    }
}

TEST(Stratified, AGroupFillsItsGrid) {
  const auto sampler = make_sampler("stratified", {{"side", int64_t{4}}});
  const auto p = points(*sampler, 21, 32, 2);
  for (size_t first : {size_t{0}, size_t{16}})
    for (const size_t pair : {size_t{0}, size_t{2}, size_t{8}}) {
      std::set<std::pair<int, int>> cells;
      for (size_t s = first; s < first + 16; ++s)
        cells.insert({static_cast<int>(p[s][pair] * 4), static_cast<int>(p[s][pair + 1] * 4)});
      EXPECT_EQ(cells.size(), 16U);
    }
}

// The mean of n independent numbers has exactly 1/n of their variance, whatever the function of the dimensions. Over 20
// 000 pixels the ratio has a standard error of 1 %; 5 of them are allowed (6e-7 false alarms).
TEST(Random, TheVarianceOfAMeanIsThatOfIndependentSamples) {
  const auto sampler = make_sampler("random");
  constexpr uint32_t kPixels = 20'000, kSamples = 16;
  double squares = 0;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0;
    for (const auto& p : points(*sampler, mix_bits(pixel + 1), kSamples, 2))
      for (const float v : p) mean += (v - 0.5) / kSamples;
    squares += mean * mean;
  }
  const double ideal = 2.0 * kBlockSize / 12 / kSamples;
  EXPECT_NEAR(squares / kPixels / ideal, 1, 0.05);
}

// Root mean square error over 200 scrambles of a smooth integrand: -1/2 for random points, much steeper for Sobol'.
TEST(Sobol, ConvergesFasterThanRandomNumbers) {
  const auto rmse = [](const char* name, uint32_t n, size_t dimensions) {
    const auto sampler = make_sampler(name);
    double squares = 0;
    constexpr uint32_t kScrambles = 200;
    for (uint32_t r = 0; r < kScrambles; ++r) {
      double mean = 0;
      for (const auto& p : points(*sampler, mix_bits(r + 5), n, 1)) {
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
