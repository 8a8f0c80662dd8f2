#include "viewer/viewport/error_layer.h"

#include <algorithm>
#include <cmath>

#include "spectrum/colormap.h"
#include "viewer/viewport/srgb.h"

namespace etendue::viewer {
namespace {

constexpr int kRadius = 2;  // of the averaging window, pixels
constexpr double kStops = 5;
constexpr double kBrightestQuantile = 0.99;

// The squared standard error of each pixel, averaged over the channels.
std::vector<double> pixel_variances(const film::Film& film) {
  std::vector<double> variances;
  variances.reserve(film.pixels().size());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Rgb v = film.variance_of_mean(x, y);
      variances.push_back((double{v.r} + double{v.g} + double{v.b}) / 3);
    }
  return variances;
}

// Moving averages in one direction, over windows that are cut off at the borders. The values form `count` lines of
// `length` numbers: lines start `line_step` apart, and the numbers of a line are `step` apart.
std::vector<double> smoothed(const std::vector<double>& values, int count, int length, int line_step, int step) {
  std::vector<double> means(values.size());
  for (int line = 0; line < count; ++line)
    for (int i = 0; i < length; ++i) {
      const int first = std::max(0, i - kRadius);
      const int last = std::min(length - 1, i + kRadius);
      double sum = 0;
      for (int k = first; k <= last; ++k) sum += values[static_cast<size_t>(line * line_step + k * step)];
      means[static_cast<size_t>(line * line_step + i * step)] = sum / (last - first + 1);
    }
  return means;
}

}  // namespace

std::vector<double> pixel_errors(const film::Film& film) {
  const int width = film.width();
  const int height = film.height();
  std::vector<double> errors = smoothed(pixel_variances(film), height, width, width, 1);
  errors = smoothed(errors, width, height, 1, width);
  for (double& e : errors) e = std::sqrt(e);
  return errors;
}

ErrorLayer error_layer(const film::Film& film) {
  const std::vector<double> errors = pixel_errors(film);
  ErrorLayer layer;
  layer.pixels.assign(errors.size(), Rgb(0));
  if (errors.empty()) return layer;
  auto sorted = errors;
  const auto rank = static_cast<std::ptrdiff_t>(kBrightestQuantile * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  layer.high = sorted[static_cast<size_t>(rank)];
  layer.low = layer.high * std::exp2(-kStops);
  if (layer.high <= 0) return layer;
  for (size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] <= 0) continue;
    const double position = std::log2(errors[i] / layer.low) / kStops;
    layer.pixels[i] = linear_from_srgb(viridis(static_cast<float>(position)));
  }
  return layer;
}

}  // namespace etendue::viewer
