#include "metrics/heat_map.h"

#include <cmath>

#include "spectrum/colormap.h"

namespace etendue::metrics {
namespace {

double mean_radiance(const std::vector<float>& pixels) {
  double sum = 0;
  for (const float v : pixels) sum += v;
  return std::max(sum / static_cast<double>(pixels.size()), 1e-30);
}

// The contribution of one channel to the mapped value.
double term(double x, double r, double mean, HeatMap kind) {
  const double d = x - r;
  if (kind == HeatMap::relmse) return d * d / (r * r + 0.01);
  return kind == HeatMap::difference ? d / mean : std::abs(d) / mean;
}

Rgb color_of(double value, HeatMap kind) {
  if (kind == HeatMap::difference) return diverging_color(static_cast<float>(value));
  return viridis(static_cast<float>(kind == HeatMap::relmse ? std::sqrt(value) : value));
}

void append(std::vector<uint8_t>& bytes, const Rgb& color) {
  for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<uint8_t>(color[c] * 255 + 0.5f));
}

}  // namespace

std::vector<uint8_t> heat_map(const image::LayeredImage& image, const image::LayeredImage& reference, HeatMap kind) {
  const auto &x = image.find("")->pixels, &r = reference.find("")->pixels;
  const double mean = mean_radiance(r);
  std::vector<uint8_t> bytes;
  bytes.reserve(x.size());
  for (size_t i = 0; i + 2 < x.size(); i += 3) {
    double sum = 0;
    for (size_t c = i; c < i + 3; ++c) sum += term(x[c], r[c], mean, kind) / 3;
    append(bytes, color_of(sum, kind));
  }
  return bytes;
}

std::vector<uint8_t> color_mapped(std::span<const float> map) {
  std::vector<uint8_t> bytes;
  bytes.reserve(map.size() * 3);
  for (const float v : map) append(bytes, viridis(v));
  return bytes;
}

}  // namespace etendue::metrics
