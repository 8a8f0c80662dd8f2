#include "render/time_estimate.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace etendue::render {
namespace {

// Prior knowledge of the exponent. For point sequences it covers the range from integrands without any smoothness,
// where they are no better than random numbers, to the rate of digital nets.
constexpr TimeEstimator::Exponent kIndependentPrior{0.5, 0.02}, kSequencePrior{0.6, 0.15};
// The exponent is not expected to stay outside these bounds.
constexpr double kLeastExponent = 0.25, kLargestExponent = 1;
// Relative deviation of errors from the straight line.
constexpr double kLineDeviation = 0.05;
// Two-sided quantiles of the normal distribution for 95 % and 80 %.
constexpr double k95 = 1.96, k80 = 1.28;

}  // namespace

void TimeEstimator::add(uint32_t samples, double seconds, const film::MeasuredError& error) {
  if (!error.known || !(error.interval.low > 0)) return;
  // The interval states how uncertain the error of this image is, `variation` how much the errors of other images of the
  // same kind differ. With few bright pixels the first is small and the second large.
  const double log_error =
      std::max(std::log(error.interval.high / error.interval.low) / (2 * k95), error.variation);
  // Errors of nearly the same samples are strongly correlated, so only one of them is kept.
  const size_t n = history_.size();
  if (n >= 2 && samples < 2 * history_[n - 2].samples) history_.pop_back();
  history_.push_back({.samples = static_cast<double>(samples),
                      .seconds = seconds,
                      .log_value = std::log(error.value),
                      .error = log_error});
}

TimeEstimator::Exponent TimeEstimator::prior() const { return independent_ ? kIndependentPrior : kSequencePrior; }

TimeEstimator::Line TimeEstimator::fit_line() const {
  double weights = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& p : history_) {
    const double weight = 1 / (sqr(p.error) + sqr(kLineDeviation));
    weights += weight;
    x += weight * std::log(p.samples);
    y += weight * p.log_value;
  }
  x /= weights;
  y /= weights;
  for (const Point& p : history_) {
    const double weight = 1 / (sqr(p.error) + sqr(kLineDeviation));
    const double dx = std::log(p.samples) - x;
    xx += weight * dx * dx;
    xy += weight * dx * (p.log_value - y);
  }
  const double prior_weight = 1 / sqr(prior().error);
  const double s = (prior().value * prior_weight - xy) / (xx + prior_weight);
  return {.middle = x,
          .height = y,
          .height_error = 1 / std::sqrt(weights),
          .exponent = {std::clamp(s, kLeastExponent, kLargestExponent), 1 / std::sqrt(xx + prior_weight)}};
}

TimeEstimator::Exponent TimeEstimator::exponent() const { return history_.empty() ? prior() : fit_line().exponent; }

std::optional<Prediction> TimeEstimator::time_to(double target, double seconds) const {
  if (history_.empty()) return {};
  const Point& last = history_.back();
  if (last.log_value <= std::log(target)) return Prediction{};
  const Line line = fit_line();
  const double s = line.exponent.value;
  // Logarithms of the sample count at the target: relative to the middle of the line, and to the last measurement.
  const double from_middle = (line.height - std::log(target)) / s;
  const double growth = from_middle + line.middle - std::log(last.samples);
  // The future error is assumed to deviate from the line as much as the last one.
  const double error = std::sqrt(sqr(line.height_error) + sqr(from_middle * line.exponent.error) + sqr(last.error) +
                                 sqr(kLineDeviation)) /
                       s;
  const auto remaining = [&](double log_growth) {
    return std::max(0.0, last.seconds * std::exp(log_growth) - seconds);
  };
  return Prediction{remaining(growth), {remaining(growth - k80 * error), remaining(growth + k80 * error)}};
}

}  // namespace etendue::render
