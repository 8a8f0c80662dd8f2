#include "film/error.h"

#include <cmath>

namespace etendue::film {
namespace {

// Of the normal distribution, both sides together.
constexpr double kNinetyFivePercent = 1.96;

struct Estimate {
  double mean = 0;
  Interval interval;
};

// Symmetric in the logarithm: a mean square is positive, and its distribution leans to the right.
Estimate estimate(const RowError::Sum& sum, double numbers) {
  if (!(sum.squares > 0)) return {};
  const double factor = std::exp(kNinetyFivePercent * 2 * std::sqrt(sum.spread) / sum.squares),
               mean = sum.squares / numbers;
  return {mean, {mean / factor, mean * factor}};
}

void add(RowError::Sum& sum, const RowError::Sum& row) {
  sum.squares += row.squares, sum.spread += row.spread, sum.fourth += row.fourth;
}

}  // namespace

void RowSum::add(double squared_error) {
  sum_.squares += squared_error, sum_.fourth += squared_error * squared_error;
  ++pixels_;
  if (pixels_ > 1) products_ += squared_error * before_;
  before_ = squared_error;
  // There is a product less than there are pixels. A pixel alone: a normal number's fourth moment is three times the
  // square of its second.
  sum_.spread = pixels_ > 1 ? products_ * pixels_ / (pixels_ - 1) : squared_error * squared_error / 3;
}

ErrorEstimate error_of(std::span<const RowError> rows, double numbers) {
  RowError::Sum absolute;
  double relative = 0;
  for (const RowError& row : rows) {
    if (!row.known) return {};
    add(absolute, row.absolute), relative += row.relative;
  }
  if (!(numbers > 0)) return {};
  const Estimate a = estimate(absolute, numbers);
  // A normal number's square has twice its squared variance as variance, and three times as mean square.
  const double scatter = absolute.squares > 0 ? 0.5 * std::sqrt(2.0 / 3 * absolute.fourth) / absolute.squares : 0;
  return {
      std::sqrt(a.mean), {std::sqrt(a.interval.low), std::sqrt(a.interval.high)}, relative / numbers, scatter, true};
}

}  // namespace etendue::film
