#include "metrics/low_pass.h"

#include <cmath>

#include "metrics/separable.h"

namespace etendue::metrics {
namespace {

Kernel gaussian(double sigma) {
  const int radius = static_cast<int>(std::ceil(4 * sigma));
  std::vector<double> weights;
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    weights.push_back(std::exp(-i * i / (2 * sigma * sigma)));
    sum += weights.back();
  }
  Kernel kernel;
  for (const double w : weights) kernel.taps.push_back(static_cast<float>(w / sum));
  return kernel;
}

}  // namespace

image::LayeredImage low_passed(const image::LayeredImage& image, double sigma) {
  const Kernel kernel = gaussian(sigma);
  image::Layer filtered = *image.find("");
  const size_t channels = filtered.channels.size();
  for (size_t c = 0; c < channels; ++c) {
    Plane plane(image.width, image.height);
    for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = filtered.pixels[i * channels + c];
    const Plane smooth = convolve(plane, kernel, kernel);
    for (size_t i = 0; i < plane.values.size(); ++i) filtered.pixels[i * channels + c] = smooth.values[i];
  }
  return {.width = image.width, .height = image.height, .layers = {filtered}, .attributes = image.attributes};
}

}  // namespace etendue::metrics
