#include "film/error.h"

#include <cmath>

namespace etendue::film {
namespace {

// Quantile of the normal distribution for a two-sided interval of 95 %.
constexpr double kNormalQuantile95 = 1.96;

struct Estimate {
  double mean = 0;
  Interval interval;
};

// The interval is symmetric in the logarithm, because a mean square is positive and its distribution is right-skewed.
Estimate estimate(const RowError::Sum& sum, double values) {
  if (!(sum.squares > 0)) return {};
  const double factor = std::exp(kNormalQuantile95 * 2 * std::sqrt(sum.variance) / sum.squares);
  const double mean = sum.squares / values;
  return {.mean = mean, .interval = {mean / factor, mean * factor}};
}

}  // namespace

void RowSum::add(double squared_error) {
  sum_.squares += squared_error;
  sum_.fourth += squared_error * squared_error;
  ++pixels_;
  if (pixels_ > 1) products_ += squared_error * previous_;
  previous_ = squared_error;
  // There is one product less than there are pixels. For a single pixel, a normal distribution is assumed, whose fourth
  // moment is three times the square of the second.
  sum_.variance = pixels_ > 1 ? products_ * pixels_ / (pixels_ - 1) : squared_error * squared_error / 3;
}

ErrorEstimate error_of(std::span<const RowError> rows, double values) {
  RowError::Sum absolute;
  double relative = 0;
  bool has_light = false;
  for (const RowError& row : rows) {
    if (!row.known) return {};
    absolute.squares += row.absolute.squares;
    absolute.variance += row.absolute.variance;
    absolute.fourth += row.absolute.fourth;
    relative += row.relative;
    has_light = has_light || row.has_light;
  }
  if (!(values > 0) || !has_light) return {};
  const Estimate mse = estimate(absolute, values);
  // The square of a normal variable of variance v has the variance 2 v^2 and the second moment 3 v^2. The relative
  // deviation of a root is half that of its square.
  const double variation = absolute.squares > 0 ? 0.5 * std::sqrt(2.0 / 3 * absolute.fourth) / absolute.squares : 0;
  return {.rmse = std::sqrt(mse.mean),
          .rmse_interval = {std::sqrt(mse.interval.low), std::sqrt(mse.interval.high)},
          .approximate_relmse = relative / values,
          .rmse_variation = variation,
          .known = true};
}

}  // namespace etendue::film
