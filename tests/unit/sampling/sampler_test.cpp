// Properties of every sampler: values in range, reproducible, uniform, independent over dimensions, samples and pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

#include "base/hash.h"
#include "equations/pearson_test.h"
#include "unit/sampling/points.h"

namespace etendue {
namespace {

class EverySampler : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    sampler_ = make_sampler(GetParam());
    sampler_->prepare(0, 128);
  }
  std::unique_ptr<Sampler> sampler_;
};

TEST_P(EverySampler, ValuesAreInTheUnitIntervalAndReproducible) {
  for (uint32_t seed : {0U, 1U, 0xffffffffU}) {
    const auto a = test::points(*sampler_, seed, 300, 12);
    EXPECT_EQ(a, test::points(*sampler_, seed, 300, 12));
    for (const auto& p : a)
      for (const float v : p) ASSERT_TRUE(v >= 0 && v < 1) << v;
  }
}

TEST_P(EverySampler, TablesEqualSingleBlocks) {
  std::array<uint32_t, 53> seeds;
  for (size_t i = 0; i < seeds.size(); ++i) seeds[i] = mix_bits(static_cast<uint32_t>(i) + 3);
  const auto table = std::make_unique<SampleTable>();
  for (const uint32_t sample : {0U, 5U, 127U, 1000U})
    for (const uint32_t block : {0U, 1U, 7U, 8U, 40U}) {
      sampler_->blocks(seeds, sample, block, dimensions(0, kBlockSize), *table);
      for (size_t i = 0; i < seeds.size(); ++i) {
        SampleBlock alone;
        sampler_->block(seeds[i], sample, block, alone);
        for (size_t k = 0; k < alone.size(); ++k) ASSERT_EQ(table->values[k][i], alone[k]);
      }
    }
}

// Chi-square test with 16 bins for each dimension of a sample over many pixels; 1 % false alarms in total.
TEST_P(EverySampler, EachDimensionIsUniform) {
  constexpr int kBins = 16, kPixels = 4096, kDimensions = 96;
  constexpr uint32_t kSamples[] = {0, 1, 77};
  const double significance = 1 - std::pow(0.99, 1.0 / (kDimensions * std::size(kSamples)));
  for (const uint32_t s : kSamples) {
    std::vector<std::array<int, kBins>> counts(kDimensions);
    for (uint32_t pixel = 0; pixel < kPixels; ++pixel)
      for (uint32_t d = 0; d < kDimensions; d += kBlockSize) {
        SampleBlock values;
        sampler_->block(mix_bits(pixel + 17), s, d / kBlockSize, values);
        for (size_t i = 0; i < values.size(); ++i) ++counts[d + i][static_cast<size_t>(values[i] * kBins)];
      }
    for (size_t d = 0; d < kDimensions; ++d) {
      double statistic = 0;
      for (const int n : counts[d]) statistic += sqr(n - double{kPixels} / kBins) / (double{kPixels} / kBins);
      EXPECT_GT(equations::chi_square_survival(statistic, kBins - 1), significance)
          << "sample " << s << " dimension " << d;
    }
  }
}

// The same for sample numbers beyond 2^16 and dimensions beyond 1000; 1 % false alarms in total.
TEST_P(EverySampler, LateDimensionsOfLateSamplesAreUniform) {
  constexpr int kBins = 16, kPixels = 4096;
  constexpr uint32_t kSamples[] = {(1U << 16) + 5, (1U << 31) + 3}, kBlocks[] = {125, 1250};
  const double significance = 1 - std::pow(0.99, 1.0 / (kBlockSize * std::size(kSamples) * std::size(kBlocks)));
  for (const uint32_t s : kSamples)
    for (const uint32_t block : kBlocks) {
      std::array<std::array<int, kBins>, kBlockSize> counts{};
      for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        SampleBlock values;
        sampler_->block(mix_bits(pixel + 23), s, block, values);
        for (size_t i = 0; i < values.size(); ++i) ++counts[i][static_cast<size_t>(values[i] * kBins)];
      }
      for (size_t i = 0; i < kBlockSize; ++i) {
        double statistic = 0;
        for (const int n : counts[i]) statistic += sqr(n - double{kPixels} / kBins) / (double{kPixels} / kBins);
        EXPECT_GT(equations::chi_square_survival(statistic, kBins - 1), significance)
            << "sample " << s << " block " << block << " dimension " << i;
      }
    }
}

// In the first samples of many pixels, pairs of dimensions and neighbouring pixels are uncorrelated within 4.5 standard
// errors (1.3e-2 false alarms over all pairs and samplers). Seeds of dimensions or pixels in arithmetic progression fail.
TEST_P(EverySampler, DimensionsAndPixelsAreIndependent) {
  constexpr uint32_t kPixels = 20'000;
  std::vector<std::vector<float>> first;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) first.push_back(test::points(*sampler_, pixel, 1, 2)[0]);
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

// A dimension of a sample is not equal to another dimension of the next samples, nor correlated with it: 5 standard
// errors over many pixels (7e-3 false alarms over all pairs and samplers).
TEST_P(EverySampler, SamplesOfAPixelAreIndependent) {
  constexpr uint32_t kPixels = 10'000, kSamples = 4;
  constexpr size_t kDimensions = 16;
  std::array<std::array<std::array<double, kDimensions>, kDimensions>, kSamples> sums{};
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    const auto p = test::points(*sampler_, mix_bits(pixel + 99), kSamples, 2);
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

// The mean over pixels of a product over the dimensions of two blocks, as in a path integral. z-test, 1 % false alarms
// over all samplers.
TEST_P(EverySampler, ProductsOverManyDimensionsAreUnbiased) {
  constexpr int kPixels = 2000;
  double sum = 0, squares = 0;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0;
    for (const auto& p : test::points(*sampler_, mix_bits(pixel * 7 + 3), 16, 2)) {
      double product = 1;
      for (const float v : p) product *= 0.5 + v;
      mean += product / 16;
    }
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / kPixels, error = std::sqrt((squares / kPixels - mean * mean) / kPixels);
  EXPECT_LT(std::abs(mean - 1), 3.1 * error) << mean << " +- " << error;
}

// Blocks are computed by several threads concurrently.
TEST_P(EverySampler, IsThreadSafe) {
  const auto expected = test::points(*sampler_, 5, 200, 10);
  std::vector<std::vector<std::vector<float>>> results(4);
  {
    std::vector<std::jthread> threads;
    for (auto& result : results) threads.emplace_back([&] { result = test::points(*sampler_, 5, 200, 10); });
  }
  for (const auto& result : results) EXPECT_EQ(result, expected);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& info : sampler_infos()) names.push_back(info.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Samplers, EverySampler, testing::ValuesIn(all_names()), [](const auto& instance) {
  std::string name = instance.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(SamplerRegistry, ListsAllSamplersStartingWithSobol) {
  const auto names = all_names();
  EXPECT_EQ(std::vector<std::string>(names.begin(), names.begin() + 4),
            (std::vector<std::string>{"sobol", "pmj02", "halton", "stratified"}));
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const auto& info : sampler_infos()) {
    EXPECT_EQ(info.joint_dimensions == 0, info.independent) << info.name;
    EXPECT_FALSE(info.padding.empty()) << info.name;
  }
  EXPECT_EQ(find_sampler("no-such"), nullptr);
  EXPECT_EQ(make_sampler("no-such"), nullptr);
  EXPECT_EQ(find_sampler("stratified")->parameters.at(0).name, "side");
}

}  // namespace
}  // namespace etendue
