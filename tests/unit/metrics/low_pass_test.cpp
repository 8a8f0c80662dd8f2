// Low-pass filtered images: the Gaussian filter has closed forms for constants, single pixels and stripes
#include "metrics/low_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace etendue {
namespace {

constexpr int kSide = 64;

template <class Value>
image::LayeredImage image_of(Value&& value) {
  image::LayeredImage image{.width = kSide, .height = kSide};
  image.layers.push_back({"", {"R", "G", "B"}, {}});
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int c = 0; c < 3; ++c) image.layers[0].pixels.push_back(value(x, y, c));
  return image;
}
float at(const image::LayeredImage& image, int x, int y, int c) {
  return image.find("")->pixels[static_cast<size_t>((y * kSide + x) * 3 + c)];
}

TEST(LowPass, KeepsConstants) {
  const auto filtered = metrics::low_passed(image_of([](int, int, int c) { return 1.0f + c; }), 2);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(filtered, 1, 40, c), 1 + c, 1e-5);
}

// A single pixel becomes the density of the normal distribution, for deviations above a pixel.
TEST(LowPass, APixelBecomesAGaussian) {
  constexpr double kSigma = 2;
  const auto filtered =
      metrics::low_passed(image_of([](int x, int y, int c) { return x == 32 && y == 32 && c == 1 ? 1.0f : 0.0f; }), kSigma);
  for (int d = 0; d < 6; ++d) {
    const double density = std::exp(-2 * d * d / (2 * kSigma * kSigma)) / (2 * std::numbers::pi * kSigma * kSigma);
    EXPECT_NEAR(at(filtered, 32 + d, 32 - d, 1), density, 1e-5 + 1e-3 * density);
  }
  EXPECT_EQ(at(filtered, 32, 32, 0), 0);
}

// A wave of frequency f per pixel is multiplied by exp(-2 (pi f sigma)^2).
TEST(LowPass, WavesHaveTheResponseOfAGaussian) {
  for (const double frequency : {1.0 / 16, 1.0 / 8, 1.0 / 4}) {
    const auto wave = image_of(
        [&](int x, int, int) { return static_cast<float>(std::cos(2 * std::numbers::pi * frequency * (x - 32))); });
    const double response = std::exp(-2 * std::pow(std::numbers::pi * frequency * 1.5, 2));
    EXPECT_NEAR(at(metrics::low_passed(wave, 1.5), 32, 20, 2), response, 1e-3);
  }
}

}  // namespace
}  // namespace etendue
