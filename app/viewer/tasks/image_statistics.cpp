#include "viewer/tasks/image_statistics.h"

#include <algorithm>
#include <cmath>

namespace etendue::viewer {
namespace {

int bin_of(float luminance) { return static_cast<int>(std::floor(std::log2(double{luminance}) * kBinsPerStop)); }

void count_luminances(std::span<const Rgb> pixels, ImageStatistics& result) {
  float max = 0;
  float min = INFINITY;
  for (const Rgb& pixel : pixels) {
    if (!is_finite(pixel)) {
      ++result.invalid;
      continue;
    }
    const float y = luminance(pixel);
    if (y <= 0) {
      ++result.black;
      continue;
    }
    max = std::max(max, y);
    min = std::min(min, y);
  }
  if (max == 0) return;
  const int high = bin_of(max);
  result.low = std::max(bin_of(min), high - kMaxStops * kBinsPerStop + 1);
  result.luminance_counts.resize(static_cast<size_t>(high - result.low + 1));
  for (const Rgb& pixel : pixels)
    if (const float y = luminance(pixel); is_finite(pixel) && y > 0)
      ++result.luminance_counts[static_cast<size_t>(std::max(bin_of(y) - result.low, 0))];
}

void count_displayed(std::span<const Rgb> pixels, int width, float exposure, image::ToneCurve curve,
                     ImageStatistics& result) {
  const float scale = std::exp2(exposure);
  uint64_t above_white = 0;
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (!is_finite(pixels[i])) continue;
    const Rgb shown = image::displayed(pixels[i], exposure, curve);
    const auto x = static_cast<int>(i % static_cast<size_t>(width));
    const int column = x * result.columns / width;
    for (int k = 0; k < 3; ++k) {
      const auto value =
          std::clamp(static_cast<int>(std::lround(shown[k] * (kDisplayLevels - 1))), 0, kDisplayLevels - 1);
      const int level = value * kWaveformLevels / kDisplayLevels;
      ++result.displayed_counts[static_cast<size_t>(k)][static_cast<size_t>(value)];
      ++result.waveform[static_cast<size_t>(k)][static_cast<size_t>(column * kWaveformLevels + level)];
    }
    if (scale * max_component(pixels[i]) > 1) ++above_white;
  }
  result.above_white = static_cast<double>(above_white) / static_cast<double>(pixels.size());
}

}  // namespace

ImageStatistics image_statistics(std::span<const Rgb> pixels, int width, float exposure, image::ToneCurve curve) {
  ImageStatistics result;
  result.pixels = pixels.size();
  if (pixels.empty()) return result;
  result.columns = std::min(width, kWaveformColumns);
  for (auto& channel : result.waveform) channel.resize(static_cast<size_t>(result.columns * kWaveformLevels));
  count_luminances(pixels, result);
  count_displayed(pixels, width, exposure, curve, result);
  for (size_t k = 0; k < 3; ++k) {
    result.clipped_low[k] =
        static_cast<double>(result.displayed_counts[k].front()) / static_cast<double>(pixels.size());
    result.clipped_high[k] =
        static_cast<double>(result.displayed_counts[k].back()) / static_cast<double>(pixels.size());
  }
  return result;
}

}  // namespace etendue::viewer
