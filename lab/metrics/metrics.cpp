#include "metrics/metrics.h"

#include <cmath>

namespace etendue::metrics {
namespace {

const std::vector<float>& pixels_of(const image::LayeredImage& image) { return image.find("")->pixels; }

bool has_rgb(const image::LayeredImage& image) {
  const image::Layer* beauty = image.find("");
  return beauty && beauty->channels.size() == 3;
}

std::string size_text(const image::LayeredImage& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

double relative_difference(double x, double r) {
  const double scale = 0.5 * (std::abs(x) + std::abs(r));
  return scale > 0 ? std::abs(x - r) / scale : 0;
}

}  // namespace

Metrics metrics_of(std::span<const float> x, std::span<const float> r) {
  Metrics m;
  double peak = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double a = x[i], b = r[i], d = a - b;
    m.mse += d * d;
    m.relmse += d * d / (b * b + 0.01);
    m.mae += std::abs(d);
    m.smape += relative_difference(a, b);
    m.bias += d;
    peak = std::max(peak, b);
  }
  const auto n = static_cast<double>(x.size());
  for (double* sum : {&m.mse, &m.relmse, &m.mae, &m.smape, &m.bias}) *sum /= n;
  m.rmse = std::sqrt(m.mse);
  m.psnr = m.mse > 0 ? 10 * std::log10(peak * peak / m.mse) : INFINITY;
  return m;
}

double displayed_mse(std::span<const float> image, std::span<const float> reference,
                     const film::DisplayTransform& display) {
  double sum = 0;
  for (size_t i = 0; i + 2 < image.size(); i += 3) {
    const Rgb a = display({image[i], image[i + 1], image[i + 2]});
    const Rgb b = display({reference[i], reference[i + 1], reference[i + 2]});
    for (int c = 0; c < 3; ++c) sum += sqr(double{a[c]} - double{b[c]});
  }
  return sum / static_cast<double>(image.size());
}

Result<Metrics> compare(const image::LayeredImage& image, const image::LayeredImage& reference) {
  if (!has_rgb(image) || !has_rgb(reference)) return input_error("compare: an image has no R, G and B channels");
  if (image.width != reference.width || image.height != reference.height)
    return input_error("compare: the images differ in size, " + size_text(image) + " and " + size_text(reference) +
                       "; give two images of the same size");
  const auto &x = pixels_of(image), &r = pixels_of(reference);
  for (size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i]) || !std::isfinite(r[i]))
      return input_error("compare: pixel " + std::to_string(i / 3) +
                         " is not a finite number; nothing can be measured");
  return metrics_of(x, r);
}

}  // namespace etendue::metrics
