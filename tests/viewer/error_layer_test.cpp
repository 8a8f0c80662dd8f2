// The error AOV: its scale and its colours.
#include "viewer/viewport/error_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace etendue::viewer {
namespace {

// Uniform noise, `left` wide in the left half of the film and `right` wide in the right one, eight samples.
film::Film noisy(float left, float right) {
  film::Film film(64, 32);
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> uniform;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      for (uint32_t s = 0; s < 8; ++s) film.add(x, y, s % 2, Rgb(1 + uniform(engine) * (x < 32 ? left : right)));
  return film;
}

TEST(ErrorLayer, ScaleEndsAtTheLargestErrors) {
  const ErrorLayer layer = error_layer(noisy(0.1f, 0.1f));
  // The error of a mean of eight; over 25 pixels it is known to a fifth, and one pixel in a hundred is higher.
  const double error = 0.1 / std::sqrt(12.0 * 8);
  EXPECT_GT(layer.high, error);
  EXPECT_LT(layer.high, 2 * error);
  EXPECT_NEAR(layer.low, layer.high / 32, 1e-9);
}

TEST(ErrorLayer, BrighterIsWorse) {
  const ErrorLayer layer = error_layer(noisy(0.2f, 0.02f));
  const auto mean = [&](int first) {
    double sum = 0;
    for (size_t y = 0; y < 32; ++y)
      for (size_t x = 0; x < 28; ++x) sum += luminance(layer.pixels[y * 64 + static_cast<size_t>(first) + x]);
    return sum / (32 * 28);
  };
  EXPECT_GT(mean(0), 3 * mean(36));
}

TEST(ErrorLayer, ZeroErrorIsBlack) {
  const ErrorLayer layer = error_layer(noisy(0, 0));
  EXPECT_EQ(layer.high, 0);
  for (const Rgb& pixel : layer.pixels) ASSERT_EQ(pixel, Rgb(0));
}

}  // namespace
}  // namespace etendue::viewer
