// relMSE of films with known radiance, and the coverage of the stated interval.
//
// The interval contains the true value for 95 of 100 films. With 60 films, coverage of 50 or fewer has a probability of
// 7e-4 at 95 %. Seeds are fixed.
#include "film/relative_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace etendue::film {
namespace {

constexpr int kWidth = 48, kHeight = 40, kFilms = 60, kHeldAtLeast = 51;
constexpr uint32_t kSamples = 16;

using Truth = std::function<double(int, int)>;                        // the radiance of a pixel
using Noise = std::function<double(double radiance, std::mt19937&)>;  // a sample with that expectation

Film film_of(const Truth& truth, const Noise& noise, uint32_t seed) {
  std::mt19937 random(seed);
  Film film(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (uint32_t i = 0; i < kSamples; ++i)
        film.add(x, y, i % kHalfBuffers, Rgb(static_cast<float>(noise(truth(x, y), random))));
  return film;
}

double relmse_of(const Film& film, const Truth& truth) {
  double sum = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double r = truth(x, y), e = double{film.mean(x, y).r} - r;
      sum += e * e / (r * r + 0.01);
    }
  return sum / (kWidth * kHeight);
}

// The number of films whose interval contains the true relMSE, the mean relative deviation of the estimate, and the
// mean relative width of the interval.
struct Coverage {
  int held = 0;
  double bias = 0, ratio = 0;
};

Coverage covered(const Truth& truth, const Noise& noise) {
  Coverage c;
  for (uint32_t i = 0; i < kFilms; ++i) {
    const Film film = film_of(truth, noise, i);
    const double relmse = relmse_of(film, truth);
    const auto stated = relative_error(film);
    c.held += stated && relmse >= stated->interval.low && relmse <= stated->interval.high;
    c.bias += (stated->relmse / relmse - 1) / kFilms;
    c.ratio += stated->interval.high / stated->interval.low / kFilms;
  }
  return c;
}

double smooth(int x, int y) { return 0.3 + 0.2 * std::sin(0.1 * x) * std::cos(0.08 * y); }
double edges(int x, int y) { return x < 20 ? 0.02 : y < 17 ? 5 : 0.4; }
double exponential(double r, std::mt19937& random) { return r * std::exponential_distribution<double>()(random); }
// One sample of 50 carries all of the radiance.
double sparse(double r, std::mt19937& random) { return std::bernoulli_distribution(0.02)(random) ? 50 * r : 0; }

TEST(RelativeError, CoversSmoothRadiance) {
  const Coverage c = covered(smooth, exponential);
  EXPECT_GE(c.held, kHeldAtLeast);
  EXPECT_NEAR(c.bias, 0, 0.1);
  EXPECT_LT(c.ratio, 1.5);
}

TEST(RelativeError, CoversEdges) {
  const Coverage c = covered(edges, exponential);
  EXPECT_GE(c.held, kHeldAtLeast);
  EXPECT_NEAR(c.bias, 0, 0.1);
  EXPECT_LT(c.ratio, 1.5);
}

// The mean of 48 pixels depends on fifteen bright samples here, and its inverse square is too large on average. The
// interval must cover this bias as well.
TEST(RelativeError, CoversSparseSamples) { EXPECT_GE(covered(smooth, sparse).held, kHeldAtLeast); }

TEST(RelativeError, CoversSparseSamplesAtEdges) { EXPECT_GE(covered(edges, sparse).held, kHeldAtLeast); }

TEST(RelativeError, IsUnknownUntilEveryPixelHasBothHalfBuffers) {
  Film film = film_of(smooth, exponential, 0);
  film.clear_rows(kHeight - 1, kHeight);
  EXPECT_FALSE(relative_error(film));
}

TEST(RelativeError, IsZeroWithoutNoise) {
  const auto stated = relative_error(film_of(
      edges, [](double r, std::mt19937&) { return r; }, 0));
  ASSERT_TRUE(stated);
  EXPECT_EQ(stated->relmse, 0);
  EXPECT_EQ(stated->interval.high, 0);
}

// The value can be recomputed from the image and its variance layer.
TEST(RelativeError, EqualsTheValueOfTheSavedImage) {
  const Film film = film_of(edges, exponential, 1);
  std::vector<float> rgb, variance;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (size_t c = 0; c < 3; ++c) {
        rgb.push_back(film.mean(x, y)[c]);
        variance.push_back(film.variance_of_mean(x, y)[c]);
      }
  EXPECT_EQ(relative_error(kWidth, kHeight, rgb, variance).relmse, relative_error(film)->relmse);
}

}  // namespace
}  // namespace etendue::film
