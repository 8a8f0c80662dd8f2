#include "advisor/true_error.h"

#include <cmath>

namespace etendue::advisor {
namespace {

// One kind of mean square over pixels; neighbours are independent, channels of a pixel are not.
class Sum {
 public:
  void begin_pixel() { product_ = 0, spread_ = 0; }
  // With e the picture's error and s^2 the variance of a half: the product has the variance 2 e^2 s^2 + s^4, of which
  // 2 (x-a)(x-b) v + v^2 with v = (a-b)^2 / 2 is an estimate. Channels are taken to err together.
  void add(double to_first, double to_second, double weight) {
    const double product = to_first * to_second * weight, v = 0.5 * sqr(to_first - to_second) * weight;
    product_ += product;
    spread_ += std::sqrt(std::max(0.0, 2 * product * v + v * v));
  }
  void end_pixel() { products_ += product_, variance_ += sqr(spread_); }

  MeanSquare mean(double numbers) const { return {products_ / numbers, std::sqrt(std::max(0.0, variance_)) / numbers}; }

 private:
  double product_ = 0, spread_ = 0, products_ = 0, variance_ = 0;
};

}  // namespace

double MeanSquare::root() const { return std::sqrt(std::max(0.0, value)); }

film::Interval MeanSquare::root_interval(double sigmas) const {
  const double margin = sigmas * standard_error;
  return {std::sqrt(std::max(0.0, value - margin)), std::sqrt(std::max(0.0, value + margin))};
}

TrueError true_error(std::span<const float> picture, const film::Film& other) {
  Sum absolute, relative;
  size_t i = 0;
  for (const auto& pixel : other.pixels()) {
    absolute.begin_pixel(), relative.begin_pixel();
    for (size_t c = 0; c < 3; ++c, ++i) {
      const double x = double{picture[i]};
      const double a = pixel.sum[0][c] / std::max(1u, pixel.count[0]),
                   b = pixel.sum[1][c] / std::max(1u, pixel.count[1]);
      absolute.add(x - a, x - b, 1);
      relative.add(x - a, x - b, 1 / (sqr(0.5 * (a + b)) + 0.01));
    }
    absolute.end_pixel(), relative.end_pixel();
  }
  const auto numbers = static_cast<double>(std::max<size_t>(i, 1));
  return {absolute.mean(numbers), relative.mean(numbers)};
}

}  // namespace etendue::advisor
