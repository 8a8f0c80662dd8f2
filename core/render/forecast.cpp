#include "render/forecast.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace etendue::render {
namespace {

constexpr Forecast::Exponent kPrior{0.5, 0.1};
// The first samples say little about the later ones: nets are incomplete, rare paths not yet met.
constexpr double kLeastSamples = 4;
// How far back the exponent is looked for, and how straight the curve is taken to be over that stretch.
constexpr double kStretch = 16, kBend = 0.05;
// Of the normal distribution: 95 and 80 % within.
constexpr double k95 = 1.96, k80 = 1.28;

}  // namespace

void Forecast::add(uint32_t samples, double seconds, const film::ErrorEstimate& error) {
  if (!error.known || !(error.rmse_interval.low > 0)) return;
  const double spread = std::log(error.rmse_interval.high / error.rmse_interval.low) / (2 * k95);
  history_.push_back({static_cast<double>(samples), seconds, std::log(error.rmse), spread});
}

Forecast::Exponent Forecast::exponent() const {
  if (history_.empty()) return kPrior;
  const Point& last = history_.back();
  const auto first = std::find_if(history_.begin(), history_.end(), [&](const Point& p) {
    return p.samples >= std::max(kLeastSamples, last.samples / kStretch);
  });
  const double stretch = first == history_.end() ? 0 : std::log(last.samples / first->samples);
  if (!(stretch > 0)) return kPrior;
  const double seen = (first->log_rmse - last.log_rmse) / stretch;
  const double variance = (sqr(first->error) + sqr(last.error)) / sqr(stretch) + sqr(kBend);
  const double weight = sqr(kPrior.error) / (sqr(kPrior.error) + variance);
  const double value = kPrior.value + weight * (seen - kPrior.value);
  // Slower than 1/4 or faster than 1 it will not stay.
  return {std::clamp(value, 0.25, 1.0), kPrior.error * std::sqrt(1 - weight)};
}

std::optional<Prediction> Forecast::until(double target, double now) const {
  if (history_.empty()) return {};
  const Point& last = history_.back();
  const double missing = last.log_rmse - std::log(target);
  if (missing <= 0) return Prediction{};
  const Exponent s = exponent();
  const double growth = missing / s.value;  // of the logarithm of samples
  const double error = std::hypot(last.error / s.value, missing * s.error / sqr(s.value));
  const auto left = [&](double log_growth) { return std::max(0.0, last.seconds * std::exp(log_growth) - now); };
  return Prediction{left(growth), {left(growth - k80 * error), left(growth + k80 * error)}};
}

}  // namespace etendue::render
