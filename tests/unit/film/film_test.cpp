// The film: sums, half-buffers, error estimates, and reconstruction filters [Lang, eq. 8.47-8.54].
#include <gtest/gtest.h>

#include <random>

#include "equations/pearson_test.h"
#include "film/film.h"
#include "film/filter.h"

namespace etendue::film {
namespace {

TEST(Film, MeanIncludesBothHalfBuffers) {
  Film film(1, 1);
  film.add(0, 0, 0, Rgb(1, 2, 3));
  film.add(0, 0, 1, Rgb(3, 4, 5));
  film.add(0, 0, 0, Rgb(2, 3, 4));
  EXPECT_EQ(film.samples(0, 0), 3U);
  EXPECT_EQ(film.mean(0, 0), Rgb(2, 3, 4));
}

// Samples that cannot be radiance are counted by cause and do not affect the mean.
TEST(Film, NegativeSamplesCountWhereTheyAreAllowed) {
  film::Film film(1, 1);
  film.allow_negative_samples(true);
  EXPECT_TRUE(film.add(0, 0, 0, Rgb(-1)));
  EXPECT_TRUE(film.add(0, 0, 1, Rgb(4)));
  EXPECT_EQ(film.mean(0, 0), Rgb(1.5f));
  EXPECT_FALSE(film.add(0, 0, 0, Rgb(-std::numeric_limits<float>::infinity())));
  EXPECT_FALSE(film.add(0, 0, 0, Rgb(std::numeric_limits<float>::quiet_NaN())));
  EXPECT_EQ(film.invalid_samples().total(), 2U);
}

TEST(Film, InvalidSamplesAreCountedByCause) {
  Film film(1, 1);
  film.add(0, 0, 0, Rgb(NAN, 0, 0));
  film.add(0, 0, 1, Rgb(INFINITY, 1, 1));
  film.add(0, 0, 0, Rgb(-1, 0, 0));
  film.add(0, 0, 1, Rgb(4));
  EXPECT_EQ(film.invalid_samples().nan, 1U);
  EXPECT_EQ(film.invalid_samples().infinite, 1U);
  EXPECT_EQ(film.invalid_samples().negative, 1U);
  EXPECT_EQ(film.mean(0, 0), Rgb(1));
}

// The estimated error against the true error: samples uniform in [0, 1], 40,000 pixels, tolerance 3 %.
TEST(Film, ErrorEstimateMatchesTheTrueError) {
  for (const int samples : {2, 7, 16}) {
    Film film(200, 200);
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> uniform;
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x)
        for (int s = 0; s < samples; ++s) film.add(x, y, static_cast<uint32_t>(s) % kHalfBuffers, Rgb(uniform(engine)));
    const double expected = std::sqrt(1.0 / 12 / samples);
    ASSERT_TRUE(film.error().known);
    EXPECT_NEAR(film.error().rmse, expected, 0.03 * expected) << samples;
  }
}

// The fraction of films whose error interval contains the true error, for samples from `draw` with this mean.
template <class Draw>
double coverage(int samples, double mean, Draw&& draw) {
  constexpr int kFilms = 1000, kSize = 40;
  int held = 0;
  std::mt19937 engine(11);
  for (int i = 0; i < kFilms; ++i) {
    Film film(kSize, kSize);
    double squares = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        for (int s = 0; s < samples; ++s)
          film.add(x, y, static_cast<uint32_t>(s) % kHalfBuffers, Rgb(static_cast<float>(draw(engine, x))));
        squares += sqr(film.mean(x, y).r - mean);
      }
    const double rmse = std::sqrt(squares / (kSize * kSize));
    const Interval interval = film.error().rmse_interval;
    held += interval.low <= rmse && rmse <= interval.high;
  }
  return static_cast<double>(held) / kFilms;
}

// Between 93 % and 97 % of 1000 films contain it for an interval of 95 %: four false alarms in a thousand seeds.
TEST(Film, IntervalContainsTheErrorOfTheImage) {
  std::uniform_real_distribution<double> uniform;
  EXPECT_NEAR(coverage(4, 0.5, [&](auto& engine, int) { return uniform(engine); }), 0.95, 0.02);
  // Noise that varies over the image.
  EXPECT_NEAR(coverage(8, 0.5, [&](auto& engine, int x) { return 0.5 + (uniform(engine) - 0.5) * x / 40; }), 0.95,
              0.02);
}

// Long tails make the estimate itself uncertain and the interval wide: excess kurtosis of 110 per sample.
TEST(Film, IntervalContainsTheErrorOfLongTails) {
  std::lognormal_distribution<double> lognormal(0, 1);
  EXPECT_NEAR(coverage(16, std::exp(0.5), [&](auto& engine, int) { return lognormal(engine); }), 0.95, 0.03);
}

// A black image has no noise, but the next sample may find the light.
TEST(Film, ErrorOfABlackImageIsUnknown) {
  Film film(4, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (uint32_t s = 0; s < 4; ++s) film.add(x, y, s % 2, Rgb(0));
  EXPECT_FALSE(film.error().known);
  film.add(2, 1, 0, Rgb(0.5f));
  EXPECT_TRUE(film.error().known);
  EXPECT_GT(film.error().rmse, 0);
}

TEST(Film, ErrorIsUnknownWhileAHalfBufferIsEmpty) {
  Film film(2, 1);
  film.add(0, 0, 0, Rgb(1));
  film.add(0, 0, 1, Rgb(1));
  film.add(1, 0, 0, Rgb(1));
  EXPECT_FALSE(film.error().known);
}

class EveryFilter : public testing::TestWithParam<FilterKind> {};

// Offsets are distributed as the filter: chi-square test with 24 cells, 1 % false alarms for all filters together.
TEST_P(EveryFilter, SamplesFollowTheFilter) {
  const Filter filter(GetParam());
  constexpr int kCells = 24, kSamples = 200'000;
  std::array<double, kCells> counts{};
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int i = 0; i < kSamples; ++i) {
    const float x = filter.sample(Vec2(std::min(uniform(engine), kOneMinusEpsilon), 0.5f)).x;
    ASSERT_LE(std::abs(x), filter.radius() + 1e-6f);
    ++counts[std::min<size_t>(kCells - 1, static_cast<size_t>((x / filter.radius() + 1) / 2 * kCells))];
  }
  double statistic = 0, total = 0;
  for (size_t c = 0; c < kCells; ++c) {
    double expected = 0;
    constexpr int kFine = 200;
    for (int k = 0; k < kFine; ++k) {
      const double x = (2 * (static_cast<double>(c) + (k + 0.5) / kFine) / kCells - 1) * filter.radius();
      expected += filter.value(static_cast<float>(x)) * (2 * filter.radius() / kCells / kFine);
    }
    total += expected;
    if (expected * kSamples >= 5) statistic += sqr(counts[c] - expected * kSamples) / (expected * kSamples);
  }
  EXPECT_NEAR(total, 1, 1e-4);
  EXPECT_GT(equations::chi_square_survival(statistic, kCells - 1), 0.0025);
}

TEST_P(EveryFilter, BatchesEqualSingleSamples) {
  const Filter filter(GetParam());
  alignas(64) std::array<float, 32> u;
  u.fill(std::numeric_limits<float>::quiet_NaN());  // elements beyond the last one must not matter
  std::array<float, 21> alone;
  for (size_t i = 0; i < alone.size(); ++i) {
    u[i] = std::min(static_cast<float>(i) / (alone.size() - 1), kOneMinusEpsilon);
    alone[i] = filter.sample({u[i], 0.5f}).x;
  }
  filter.sample_all(u.data(), alone.size());
  for (size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(u[i], alone[i]);
}

// (1 + sin(x^2 y^2)) / 2 over [0, 10.83]^2 in 512^2 pixels with one sample each: the image of [Lang, fig. 8.21], whose
// mean is 0.5132529. Sampling at the pixel centres aliases to a different mean; the mean with any other filter differs
// by noise only.
TEST(Filter, SamplesAtPixelCentresAlias) {
  constexpr int kPixels = 512, kRuns = 16;
  const auto mean = [](FilterKind kind, unsigned seed) {
    const Filter filter(kind);
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    double sum = 0;
    for (int y = 0; y < kPixels; ++y)
      for (int x = 0; x < kPixels; ++x) {
        const Vec2 u(std::min(uniform(engine), kOneMinusEpsilon), std::min(uniform(engine), kOneMinusEpsilon));
        const Vec2 offset = filter.sample(u);
        const double px = (x + 0.5 + double{offset.x}) * 10.83 / kPixels;
        const double py = (y + 0.5 + double{offset.y}) * 10.83 / kPixels;
        sum += 0.5 * (1 + std::sin(px * px * py * py));
      }
    return sum / (kPixels * kPixels);
  };
  EXPECT_NEAR(mean(FilterKind::centre, 1), 0.5134613, 1e-6);
  EXPECT_EQ(mean(FilterKind::centre, 1), mean(FilterKind::centre, 2));
  double sum = 0, squares = 0;
  for (unsigned run = 1; run <= kRuns; ++run) {
    const double m = mean(FilterKind::box, run);
    sum += m / kRuns;
    squares += m * m / kRuns;
  }
  // Student's t with 15 degrees of freedom: 1 % false alarms.
  EXPECT_NEAR(sum, 0.5132529, 2.95 * std::sqrt((squares - sum * sum) / (kRuns - 1)));
}

INSTANTIATE_TEST_SUITE_P(Filters, EveryFilter,
                         testing::Values(FilterKind::box, FilterKind::tent, FilterKind::gaussian,
                                         FilterKind::blackman_harris));

}  // namespace
}  // namespace etendue::film
