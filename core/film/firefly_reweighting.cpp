#include "film/firefly_reweighting.h"

#include <algorithm>

namespace etendue::film {
namespace {

constexpr float kBase = 8;
constexpr int kBaseExponent = 3;
constexpr uint32_t kMinSamples = 3;

}  // namespace

FireflyReweighting::FireflyReweighting(int width, int height)
    : width_(width), height_(height), pixels_(static_cast<size_t>(width) * static_cast<size_t>(height)) {}

float FireflyReweighting::scale(int layer) { return std::ldexp(1.0f, kBaseExponent * (kFirst + layer)); }

void FireflyReweighting::add(int x, int y, const Rgb& radiance, uint32_t samples) {
  Pixel& pixel = pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  const Rgb sum = radiance * static_cast<float>(samples);
  const float bright = luminance(radiance);
  if (bright <= scale(0)) {
    pixel[0] += sum;
  } else if (bright >= scale(kLayers - 1)) {
    pixel[kLayers - 1] += sum;
  } else {
    const int layer = std::clamp(std::ilogb(bright / scale(0)) / kBaseExponent, 0, kLayers - 2);
    const auto i = static_cast<size_t>(layer);
    const float lower = (scale(layer) / bright - 1 / kBase) / (1 - 1 / kBase);
    pixel[i] += sum * lower;
    pixel[i + 1] += sum * (1 - lower);
  }
}

float FireflyReweighting::sample_count(const Pixel& pixel, int layer) {
  float count = 0;
  for (int i = std::max(0, layer - 1); i <= std::min(kLayers - 1, layer + 1); ++i)
    count += luminance(pixel[static_cast<size_t>(i)]) / scale(i);
  return count;
}

float FireflyReweighting::mean_count_around(int x, int y, int layer) const {
  float count = 0;
  int pixels = 0;
  for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u, ++pixels)
      count += sample_count(at(u, v), layer);
  return count / static_cast<float>(pixels);
}

float FireflyReweighting::weight(int x, int y, int layer, float displayed) const {
  const float expected_count = displayed / scale(layer);
  // The weight is one for any count.
  if (expected_count >= 3) return 1;
  float count = mean_count_around(x, y, layer);
  if (count >= 1) count = sample_count(at(x, y), layer);
  return std::clamp(0.5f * (count - 1 + expected_count), 0.0f, 1.0f);
}

Rgb FireflyReweighting::displayed(int x, int y, uint32_t samples) const {
  const Pixel& pixel = at(x, y);
  Rgb sum = pixel[0];
  for (int layer = 1; layer < kLayers; ++layer) {
    const Rgb& next = pixel[static_cast<size_t>(layer)];
    if (is_black(next)) continue;
    sum += samples < kMinSamples ? next : next * weight(x, y, layer, luminance(sum));
  }
  return sum * (1 / std::max(1.0f, static_cast<float>(samples)));
}

void FireflyReweighting::clear_rows(int first, int end) {
  const auto row = [&](int y) { return pixels_.begin() + static_cast<std::ptrdiff_t>(y) * width_; };
  std::fill(row(first), row(end), Pixel{});
}

}  // namespace etendue::film
