#include "viewer/viewport/difference_map.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "metrics/flip.h"
#include "spectrum/colormap.h"
#include "viewer/viewport/srgb.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr double kScaleQuantile = 0.99;  // of the absolute differences: the end of the colour scale

// Rounds up to 1, 2 or 5 times a power of ten, so that the scale changes rarely while the image converges.
float round_up(float x) {
  if (!(x > 0)) return 0;
  const float power = std::pow(10.0f, std::floor(std::log10(x)));
  for (const float digit : {1.0f, 2.0f, 5.0f})
    if (x <= digit * power * 1.0001f) return digit * power;
  return 10 * power;
}

// The quantile of the absolute values; the maximum if the quantile is zero.
float scale_of(const std::vector<float>& values) {
  std::vector<float> magnitudes(values.size());
  std::ranges::transform(values, magnitudes.begin(), [](float v) { return std::abs(v); });
  const auto rank = static_cast<std::ptrdiff_t>(kScaleQuantile * static_cast<double>(magnitudes.size() - 1));
  const auto at = magnitudes.begin() + rank;
  std::ranges::nth_element(magnitudes, at);
  return round_up(*at > 0 ? *at : *std::max_element(at, magnitudes.end()));
}

void compute_difference(DifferenceMap& map) {
  const auto& left = *map.input.left;
  const auto& right = *map.input.right;
  map.values.resize(left.size());
  for (size_t i = 0; i < left.size(); ++i) {
    const float difference = luminance(left[i]) - luminance(right[i]);
    map.values[i] = std::isfinite(difference) ? difference : 0;
  }
  map.scale = scale_of(map.values);
  constexpr int kColors = 512;
  std::array<Rgb, kColors + 1> colors;
  for (int i = 0; i <= kColors; ++i)
    colors[static_cast<size_t>(i)] = linear_from_srgb(diverging_color(2.0f * static_cast<float>(i) / kColors - 1));
  const float slope = map.scale > 0 ? 0.5f / map.scale : 0;
  std::ranges::transform(map.values, map.pixels.begin(), [&](float v) {
    return colors[static_cast<size_t>(std::clamp(v * slope + 0.5f, 0.0f, 1.0f) * kColors + 0.5f)];
  });
}

// The displayed image before the sRGB encoding, three numbers per pixel.
std::vector<float> displayed(const std::vector<Rgb>& radiance, const DifferenceInput& input) {
  std::vector<float> numbers;
  numbers.reserve(3 * radiance.size());
  const float scale = std::exp2(input.exposure);
  for (const Rgb& r : radiance) {
    const Rgb c = image::tone_mapped(r * scale, input.curve);
    numbers.insert(numbers.end(), {c.r, c.g, c.b});
  }
  return numbers;
}

void compute_flip(DifferenceMap& map, int width, int height) {
  const auto left = displayed(*map.input.left, map.input);
  const auto right = displayed(*map.input.right, map.input);
  map.values = metrics::flip_map(width, height, left, right);
  std::ranges::transform(map.values, map.pixels.begin(), [](float v) { return linear_from_srgb(viridis(v)); });
}

}  // namespace

const char* name_of(CompareMode mode) {
  constexpr const char* kNames[] = {"off", "wipe", "difference", "flip"};
  return kNames[static_cast<size_t>(mode)];
}

std::string difference_text(const DifferenceMap& map) {
  if (map.rms == 0) return "equal";
  if (map.input.mode == CompareMode::flip) return formatted("mean %.4g", map.mean);
  if (map.mean == 0) return formatted("mean 0, RMS %.4g", map.rms);
  return formatted("mean %+.4g, RMS %.4g", map.mean, map.rms);
}

std::shared_ptr<const DifferenceMap> make_difference_map(const DifferenceInput& input, int width, int height) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  auto map = std::make_shared<DifferenceMap>();
  map->input = input;
  map->pixels.resize(input.left->size());
  if (input.mode == CompareMode::flip)
    compute_flip(*map, width, height);
  else
    compute_difference(*map);
  map->mean = metrics::mean_of(map->values);
  double squares = 0;
  for (const float v : map->values) squares += double{v} * double{v};
  map->rms = std::sqrt(squares / static_cast<double>(std::max<size_t>(1, map->values.size())));
  map->seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return map;
}

}  // namespace etendue::viewer
