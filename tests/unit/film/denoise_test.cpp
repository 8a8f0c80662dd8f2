// Denoising: closed forms for constant and linear images, edges, and missing values. Seeds are fixed.
#include "film/denoise/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <thread>

namespace etendue::film::denoising {
namespace {

// Not multiples of the size of a tile.
constexpr int kWidth = 70, kHeight = 45;
constexpr auto kPixels = static_cast<size_t>(kWidth * kHeight);
constexpr size_t kAlbedo = 0, kNormal = 3;

void one_by_one(int count, const std::function<void(int)>& task) {
  for (int i = 0; i < count; ++i) task(i);
}

// The odd tasks, last first, beside the even ones.
void on_two_threads(int count, const std::function<void(int)>& task) {
  std::thread other([&] {
    for (int i = count - 1; i >= 0; --i)
      if (i % 2 == 1) task(i);
  });
  for (int i = 0; i < count; i += 2) task(i);
  other.join();
}

using Truth = std::function<float(int x, int y)>;

// The radiance `truth` with normally distributed noise of this standard deviation in each half-buffer, and features of
// value zero.
DenoiseInput input_of(const Truth& truth, float noise, uint32_t seed = 1) {
  DenoiseInput input{.width = kWidth, .height = kHeight, .half_buffers = {}, .features = {}};
  std::mt19937 engine(seed);
  std::normal_distribution<float> normal;
  for (auto& half_buffer : input.half_buffers)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float value = truth(x, y);
        half_buffer.push_back(
            {value + noise * normal(engine), value + noise * normal(engine), value + noise * normal(engine)});
      }
  for (auto& half_buffer : input.features)
    for (auto& plane : half_buffer) plane.assign(kPixels, 0);
  return input;
}

void set_feature(DenoiseInput& input, size_t feature, const Truth& value) {
  for (auto& half_buffer : input.features)
    for (size_t i = 0; i < kPixels; ++i) {
      const auto pixel = static_cast<int>(i);
      half_buffer[feature][i] = value(pixel % kWidth, pixel / kWidth);
    }
}

// A texture without structure: uniform numbers in [0, 1).
Truth white_texture(uint32_t seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> uniform;
  std::vector<float> values(kPixels);
  for (float& v : values) v = uniform(engine);
  return [values](int x, int y) { return values[static_cast<size_t>(y * kWidth + x)]; };
}

double rms_error(const std::vector<Rgb>& image, const Truth& truth) {
  double sum = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double e = double{image[static_cast<size_t>(y * kWidth + x)].g} - double{truth(x, y)};
      sum += e * e;
    }
  return std::sqrt(sum / static_cast<double>(kPixels));
}

// The error of the mean of both half-buffers.
double raw_error(float noise) { return double{noise} / std::sqrt(2.0); }

TEST(Denoise, AConstantStaysConstantUnderAnyFeatures) {
  const auto truth = [](int, int) { return 0.7f; };
  DenoiseInput input = input_of(truth, 0);
  for (size_t k = 0; k < kDenoiseFeatures; ++k) set_feature(input, k, white_texture(static_cast<uint32_t>(k)));
  for (const Rgb& pixel : denoise(input, one_by_one))
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], 0.7f, 1e-6);
}

// Two of eight unknowns are active; with full weights, the variance of the fit of 169 pixels would be about 2 / 169 of
// that of a half-buffer. The texture makes patches differ, which reduces the weights. Without features, no linear filter
// falls below the Wiener filter for a white signal of variance 1/3 in white noise of variance 1/2, whose RMS error is
// 0.447.
TEST(Denoise, RecoversAnImageThatIsLinearInAFeature) {
  const Truth texture = white_texture(5);
  const auto truth = [&](int x, int y) { return 2 + 2 * texture(x, y); };
  constexpr float kNoise = 1;
  DenoiseInput input = input_of(truth, kNoise);
  EXPECT_GT(rms_error(denoise(input, one_by_one), truth), 0.4);
  set_feature(input, kAlbedo, texture);
  EXPECT_LT(rms_error(denoise(input, one_by_one), truth), raw_error(kNoise) / 4);
}

TEST(Denoise, KeepsAnEdgeThatAFeatureShows) {
  constexpr int kEdge = 31;
  const auto step = [](int x, int) { return x < kEdge ? 0.0f : 1.0f; };
  const auto truth = [&](int x, int y) { return 1 + step(x, y); };
  constexpr float kNoise = 1;
  DenoiseInput input = input_of(truth, kNoise);
  set_feature(input, kNormal, step);
  const auto image = denoise(input, one_by_one);
  EXPECT_LT(rms_error(image, truth), raw_error(kNoise) / 4);
  for (const int x : {kEdge - 1, kEdge}) {
    double sum = 0;
    for (int y = 0; y < kHeight; ++y) sum += double{image[static_cast<size_t>(y * kWidth + x)].g};
    EXPECT_NEAR(sum / kHeight, truth(x, 0), 0.1) << x;
  }
}

// Detail far above the noise is not blurred, although no feature shows it.
TEST(Denoise, KeepsDetailAboveTheNoise) {
  const Truth truth = white_texture(7);
  constexpr float kNoise = 0.003f;
  EXPECT_LT(rms_error(denoise(input_of(truth, kNoise), one_by_one), truth), 1.2 * raw_error(kNoise));
}

TEST(Denoise, WorksWithoutFeatures) {
  const auto truth = [](int, int) { return 1.0f; };
  DenoiseInput input = input_of(truth, 0.3f);
  input.features = {};
  EXPECT_LT(rms_error(denoise(input, one_by_one), truth), raw_error(0.3f) / 4);
}

TEST(Denoise, ReplacesValuesThatAreNotFinite) {
  const auto truth = [](int, int) { return 1.0f; };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  DenoiseInput input = input_of(truth, 0.1f);
  input.half_buffers[0][100] = Rgb(kNan);
  input.half_buffers[0][2000] = input.half_buffers[1][2000] = Rgb(std::numeric_limits<float>::infinity());
  input.features[1][4][1000] = kNan;
  const auto image = denoise(input, one_by_one);
  ASSERT_EQ(image.size(), kPixels);
  for (const Rgb& pixel : image) ASSERT_TRUE(is_finite(pixel));
  EXPECT_NEAR(image[100].g, 1, 0.3);
  EXPECT_NEAR(image[1000].g, 1, 0.3);
}

// One sample per pixel has no second half-buffer, so the noise is unknown and the image stays as it is.
TEST(Denoise, OneSamplePerPixelStays) {
  Film film(kWidth, kHeight);
  const Truth value = white_texture(3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) film.add(x, y, 0, Rgb(value(x, y)));
  const DenoiseInput input{.width = kWidth, .height = kHeight, .half_buffers = half_buffer_means(film), .features = {}};
  EXPECT_LT(rms_error(denoise(input, one_by_one), value), 1e-3);
}

TEST(Denoise, EmptyImage) { EXPECT_TRUE(denoise({}, one_by_one).empty()); }

TEST(Denoise, DoesNotDependOnTheOrderOfTasks) {
  const Truth texture = white_texture(5);
  DenoiseInput input = input_of(texture, 0.5f);
  set_feature(input, kAlbedo, texture);
  EXPECT_EQ(denoise(input, one_by_one), denoise(input, on_two_threads));
}

}  // namespace
}  // namespace etendue::film::denoising
