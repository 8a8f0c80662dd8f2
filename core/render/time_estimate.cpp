#include "render/time_estimate.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace etendue::render {
namespace {

// What is known of the exponent beforehand. Of points: from random numbers, where nothing is smooth, to nets.
constexpr TimeEstimator::Exponent kIndependent{0.5, 0.02}, kPoints{0.6, 0.15};
// Slower than 1/4 or faster than 1 it will not stay.
constexpr double kSlowest = 0.25, kFastest = 1;
// How straight the curve is taken to be: by so much an error may lie beside it, in parts of itself.
constexpr double kBend = 0.05;
// Of the normal distribution: 95 and 80 % within.
constexpr double k95 = 1.96, k80 = 1.28;

}  // namespace

void TimeEstimator::add(uint32_t samples, double seconds, const film::ErrorEstimate& error) {
  if (!error.known || !(error.rmse_interval.low > 0)) return;
  // How little is known of this picture's error, or how little it says of others': few bright pixels are well known.
  const double spread =
      std::max(std::log(error.rmse_interval.high / error.rmse_interval.low) / (2 * k95), error.scatter);
  // Errors of nearly the same samples are nearly the same number: they would count twice.
  const size_t n = history_.size();
  if (n >= 2 && samples < 2 * history_[n - 2].samples) history_.pop_back();
  history_.push_back({static_cast<double>(samples), seconds, std::log(error.rmse), spread});
}

TimeEstimator::Line TimeEstimator::line() const {
  double weights = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& p : history_) {
    const double weight = 1 / (sqr(p.error) + sqr(kBend));
    weights += weight, x += weight * std::log(p.samples), y += weight * p.log_rmse;
  }
  x /= weights, y /= weights;
  for (const Point& p : history_) {
    const double weight = 1 / (sqr(p.error) + sqr(kBend)), along = std::log(p.samples) - x;
    xx += weight * along * along, xy += weight * along * (p.log_rmse - y);
  }
  const Exponent prior = independent_ ? kIndependent : kPoints;
  const double known = 1 / sqr(prior.error);
  const double s = (prior.value * known - xy) / (xx + known);
  return {x, y, 1 / std::sqrt(weights), {std::clamp(s, kSlowest, kFastest), 1 / std::sqrt(xx + known)}};
}

TimeEstimator::Exponent TimeEstimator::exponent() const {
  return history_.empty() ? (independent_ ? kIndependent : kPoints) : line().exponent;
}

std::optional<Prediction> TimeEstimator::time_to(double target, double now) const {
  if (history_.empty()) return {};
  const Point& last = history_.back();
  if (last.log_rmse <= std::log(target)) return Prediction{};
  const Line l = line();
  const double s = l.exponent.value;
  const double from_middle = (l.height - std::log(target)) / s;           // of the logarithm of samples
  const double growth = from_middle + l.middle - std::log(last.samples);  // from now on
  // The error to come will lie beside the line as much as the last one may.
  const double error =
      std::sqrt(sqr(l.height_error) + sqr(from_middle * l.exponent.error) + sqr(last.error) + sqr(kBend)) / s;
  const auto left = [&](double log_growth) { return std::max(0.0, last.seconds * std::exp(log_growth) - now); };
  return Prediction{left(growth), {left(growth - k80 * error), left(growth + k80 * error)}};
}

}  // namespace etendue::render
