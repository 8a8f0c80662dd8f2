// Errors of films with known radiance, in all measures.
#include "film/error_measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "film/relative_error.h"

namespace etendue::film {
namespace {

constexpr int kGradientWidth = 64, kGradientHeight = 150;
constexpr uint32_t kGradientSamples = 32;
constexpr DisplayTransform kDisplay{.exposure = 0.5f, .curve = image::ToneCurve::neutral};

// Radiance from dark to clipped, so that the measures differ.
Rgb gradient(int x, int y) {
  const float level = std::exp2(static_cast<float>(x) / 8 - 5);
  return {level, 0.7f * level, 0.1f + 0.001f * static_cast<float>(y)};
}

Film noisy_gradient(uint32_t seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<float> exponential;
  Film film(kGradientWidth, kGradientHeight);
  for (int y = 0; y < kGradientHeight; ++y)
    for (int x = 0; x < kGradientWidth; ++x)
      for (uint32_t i = 0; i < kGradientSamples; ++i)
        film.add(x, y, i % kHalfBuffers, gradient(x, y) * exponential(random));
  return film;
}

double error_of_gradient(const Film& film, ErrorMeasure measure) {
  double sum = 0;
  for (int y = 0; y < kGradientHeight; ++y)
    for (int x = 0; x < kGradientWidth; ++x) {
      const Rgb mean = film.mean(x, y), r = gradient(x, y);
      const Rgb shown = kDisplay(mean), shown_truth = kDisplay(r);
      for (int c = 0; c < 3; ++c) {
        const double e = double{mean[c]} - double{r[c]};
        sum += measure == ErrorMeasure::rmse       ? e * e
               : measure == ErrorMeasure::relative ? e * e / (sqr(double{r[c]}) + 0.01)
                                                   : sqr(double{shown[c]} - double{shown_truth[c]});
      }
    }
  return std::sqrt(sum / (3.0 * kGradientWidth * kGradientHeight));
}

// 20 films, three measures. An interval of 95 % misses 6 or more of 20 with a probability of 3e-4; seeds are fixed.
TEST(ErrorMeasure, IntervalsContainTheTrueError) {
  for (const ErrorMeasure measure : kErrorMeasures) {
    int held = 0;
    double ratio = 0;
    for (uint32_t seed = 0; seed < 20; ++seed) {
      const Film film = noisy_gradient(seed);
      const MeasuredError e = measured_error(film, measure, kDisplay);
      ASSERT_TRUE(e.known);
      const double error = error_of_gradient(film, measure);
      held += error >= e.interval.low && error <= e.interval.high;
      ratio += e.value / error / 20;
    }
    EXPECT_GE(held, 15) << measure_label(measure);
    EXPECT_NEAR(ratio, 1, 0.05) << measure_label(measure);
  }
}

TEST(ErrorMeasure, ClippedNoiseIsNotDisplayed) {
  Film film(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (uint32_t half = 0; half < kHalfBuffers; ++half) film.add(x, y, half, Rgb(half == 0 ? 5 : 9));
  EXPECT_EQ(measured_error(film, ErrorMeasure::displayed, {}).value, 0);
  EXPECT_NEAR(measured_error(film, ErrorMeasure::rmse, {}).value, 2, 1e-6);
  // Three stops darker, 5/8 and 9/8 are displayed as 0.81 and 1.
  EXPECT_NEAR(measured_error(film, ErrorMeasure::displayed, {.exposure = -3}).value, 0.5 * (1 - 0.8126), 1e-3);
}

// The relative error is summed over bands of 64 rows, in any order.
TEST(ErrorMeasure, BandsGiveTheErrorOfTheWholeImage) {
  const Film film = noisy_gradient(1);
  const auto whole = relative_error(film);
  ASSERT_TRUE(whole);
  const RangeRunner in_reverse = [](int count, const std::function<void(int, int)>& task) {
    for (int i = count - 1; i >= 0; --i) task(i, i + 1);
    return true;
  };
  const MeasuredError bands = measured_error(film, ErrorMeasure::relative, {}, in_reverse);
  EXPECT_NEAR(bands.value, std::sqrt(whole->relmse), 1e-9 * bands.value);
  EXPECT_NEAR(bands.interval.high, std::sqrt(whole->interval.high), 1e-9 * bands.value);
  // Bit by bit the same in any order.
  EXPECT_EQ(relative_error(film, in_reverse)->relmse, whole->relmse);
}

TEST(ErrorMeasure, IsUnknownWithoutLightOrSamples) {
  Film black(4, 4), partial(4, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (uint32_t half = 0; half < kHalfBuffers; ++half) {
        black.add(x, y, half, Rgb(0));
        if (x + y + static_cast<int>(half) > 0) partial.add(x, y, half, Rgb(1));
      }
  const RangeRunner interrupted = [](int, const std::function<void(int, int)>&) { return false; };
  for (const ErrorMeasure measure : kErrorMeasures) {
    EXPECT_FALSE(measured_error(black, measure, {}).known) << measure_label(measure);
    EXPECT_FALSE(measured_error(partial, measure, {}).known) << measure_label(measure);
    EXPECT_FALSE(measured_error(noisy_gradient(1), measure, {}, interrupted).known) << measure_label(measure);
  }
}

TEST(ErrorMeasure, FractionsAreWrittenInPerCent) {
  EXPECT_EQ(error_text(ErrorMeasure::rmse, 0.01234), "0.012");
  EXPECT_EQ(error_text(ErrorMeasure::relative, 0.01234), "1.2 %");
  EXPECT_EQ(error_text(ErrorMeasure::displayed, 0.5), "50 %");
  EXPECT_EQ(error_text(ErrorMeasure::relative, 1.1), "110 %");
}

}  // namespace
}  // namespace etendue::film
