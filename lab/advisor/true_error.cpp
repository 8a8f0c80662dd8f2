#include "advisor/true_error.h"

#include <cmath>

namespace etendue::advisor {
namespace {

// Accumulates products and their variance. Pixels are independent; the channels of a pixel are assumed to be fully
// correlated.
class ProductSum {
 public:
  void begin_pixel() {
    product_ = 0;
    deviation_ = 0;
  }
  // With e the error of the image and s^2 the variance of a half-buffer, the product has the variance 2 e^2 s^2 + s^4.
  // It is estimated by 2 (x - a)(x - b) v + v^2 with v = (a - b)^2 / 2.
  void add(double to_first, double to_second, double weight) {
    const double product = to_first * to_second * weight, v = 0.5 * sqr(to_first - to_second) * weight;
    product_ += product;
    deviation_ += std::sqrt(std::max(0.0, 2 * product * v + v * v));
  }
  void end_pixel() {
    sum_ += product_;
    variance_ += sqr(deviation_);
  }

  MeanSquare mean(double count) const { return {sum_ / count, std::sqrt(std::max(0.0, variance_)) / count}; }

 private:
  double product_ = 0, deviation_ = 0;  // of the current pixel
  double sum_ = 0, variance_ = 0;
};

}  // namespace

double MeanSquare::root() const { return std::sqrt(std::max(0.0, value)); }

film::Interval MeanSquare::root_interval(double sigmas) const {
  const double margin = sigmas * standard_error;
  return {std::sqrt(std::max(0.0, value - margin)), std::sqrt(std::max(0.0, value + margin))};
}

TrueError true_error(std::span<const float> image, const film::Film& other) {
  ProductSum absolute, relative;
  size_t i = 0;
  for (const auto& pixel : other.pixels()) {
    absolute.begin_pixel();
    relative.begin_pixel();
    for (size_t c = 0; c < 3; ++c, ++i) {
      const double x = double{image[i]};
      const double a = pixel.sum[0][c] / std::max(1u, pixel.count[0]);
      const double b = pixel.sum[1][c] / std::max(1u, pixel.count[1]);
      absolute.add(x - a, x - b, 1);
      relative.add(x - a, x - b, 1 / (sqr(0.5 * (a + b)) + 0.01));
    }
    absolute.end_pixel();
    relative.end_pixel();
  }
  const auto count = static_cast<double>(std::max<size_t>(i, 1));
  return {absolute.mean(count), relative.mean(count)};
}

}  // namespace etendue::advisor
