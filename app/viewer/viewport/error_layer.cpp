#include "viewer/viewport/error_layer.h"

#include <algorithm>
#include <cmath>

#include "spectrum/colormap.h"

namespace etendue::viewer {
namespace {

constexpr int kReach = 2;  // of the window, pixels
constexpr double kStops = 5;

// The squared standard error of each pixel, mean over the channels.
std::vector<double> variances_of(const film::Film& film) {
  std::vector<double> variances;
  variances.reserve(film.pixels().size());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Rgb v = film.variance_of_mean(x, y);
      variances.push_back((double{v.r} + double{v.g} + double{v.b}) / 3);
    }
  return variances;
}

// Means over windows along one direction, cut off at the borders: `count` lines of `length` numbers.
std::vector<double> smoothed(const std::vector<double>& values, int count, int length, int line_step, int step) {
  std::vector<double> means(values.size());
  for (int line = 0; line < count; ++line)
    for (int i = 0; i < length; ++i) {
      const int first = std::max(0, i - kReach), last = std::min(length - 1, i + kReach);
      double sum = 0;
      for (int k = first; k <= last; ++k) sum += values[static_cast<size_t>(line * line_step + k * step)];
      means[static_cast<size_t>(line * line_step + i * step)] = sum / (last - first + 1);
    }
  return means;
}

Rgb linear(const Rgb& encoded) {
  return {srgb_to_linear(encoded.r), srgb_to_linear(encoded.g), srgb_to_linear(encoded.b)};
}

}  // namespace

ErrorLayer error_layer(const film::Film& film) {
  const int w = film.width(), h = film.height();
  std::vector<double> errors = smoothed(smoothed(variances_of(film), h, w, w, 1), w, h, 1, w);
  for (double& e : errors) e = std::sqrt(e);
  ErrorLayer layer;
  layer.pixels.assign(errors.size(), Rgb(0));
  if (errors.empty()) return layer;
  auto sorted = errors;
  const auto most = sorted.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), most, sorted.end());
  layer.high = *most, layer.low = layer.high * std::exp2(-kStops);
  for (size_t i = 0; layer.high > 0 && i < errors.size(); ++i)
    if (errors[i] > 0) layer.pixels[i] = linear(viridis(static_cast<float>(std::log2(errors[i] / layer.low) / kStops)));
  return layer;
}

}  // namespace etendue::viewer
