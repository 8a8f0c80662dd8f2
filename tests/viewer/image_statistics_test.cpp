// Histograms, waveform and clipped shares of images whose distribution is known.
#include "viewer/tasks/image_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace etendue::viewer {
namespace {

// Columns of constant grey: 2^-3, 2^-2, ..., 2^4.
std::vector<Rgb> grey_columns(int width, int height) {
  std::vector<Rgb> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) pixels.emplace_back(std::exp2(static_cast<float>(x - 3)) * 1.01f);
  return pixels;
}

TEST(ImageStatistics, EachStopHasItsBin) {
  const ImageStatistics s = image_statistics(grey_columns(8, 5), 8, 0, image::ToneCurve::none);
  ASSERT_EQ(s.luminance_counts.size(), 7 * size_t{kBinsPerStop} + 1);
  EXPECT_EQ(s.low, -3 * kBinsPerStop);
  for (size_t i = 0; i < s.luminance_counts.size(); ++i)
    EXPECT_EQ(s.luminance_counts[i], i % kBinsPerStop == 0 ? 5u : 0u) << i;
}

TEST(ImageStatistics, SharesOfClippedPixels) {
  // With -1 EV the columns from 2^1 on are above white: 4 of 8, and the column of 2^0 is not.
  const ImageStatistics s = image_statistics(grey_columns(8, 5), 8, -1, image::ToneCurve::none);
  EXPECT_DOUBLE_EQ(s.above_white, 0.5);
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_DOUBLE_EQ(s.clipped_high[k], 0.5);
    EXPECT_DOUBLE_EQ(s.clipped_low[k], 0);
  }
}

TEST(ImageStatistics, WaveformHasTheDisplayedValueOfEachColumn) {
  const ImageStatistics s = image_statistics(grey_columns(8, 5), 8, 0, image::ToneCurve::none);
  ASSERT_EQ(s.columns, 8);
  for (int x = 0; x < 8; ++x) {
    const float shown =
        image::displayed(Rgb(std::exp2(static_cast<float>(x - 3)) * 1.01f), 0, image::ToneCurve::none).g;
    const int level = static_cast<int>(std::lround(shown * 255)) * kWaveformLevels / kDisplayLevels;
    for (int i = 0; i < kWaveformLevels; ++i)
      EXPECT_EQ(s.waveform[1][static_cast<size_t>(x * kWaveformLevels + i)], i == level ? 5u : 0u) << x << " " << i;
  }
}

// Black and invalid pixels are counted apart; every other pixel is in exactly one bin.
TEST(ImageStatistics, EveryPixelIsCountedOnce) {
  std::vector<Rgb> pixels = grey_columns(8, 5);
  pixels[3] = Rgb(0);
  pixels[4] = Rgb(std::numeric_limits<float>::quiet_NaN());
  pixels[5] = Rgb(1e-30f);
  const ImageStatistics s = image_statistics(pixels, 8, 0, image::ToneCurve::agx);
  EXPECT_EQ(s.black, 1u);
  EXPECT_EQ(s.invalid, 1u);
  EXPECT_EQ(std::accumulate(s.luminance_counts.begin(), s.luminance_counts.end(), uint64_t{0}), 38u);
  EXPECT_EQ(s.luminance_counts.size(), size_t{kMaxStops * kBinsPerStop});
  EXPECT_EQ(s.luminance_counts.front(), 1u);
  for (const auto& channel : s.displayed_counts)
    EXPECT_EQ(std::accumulate(channel.begin(), channel.end(), uint64_t{0}), 39u);
}

}  // namespace
}  // namespace etendue::viewer
