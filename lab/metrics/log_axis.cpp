#include "metrics/log_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace etendue::metrics {

LogAxis::LogAxis(double low, double high, double at_low, double at_high)
    : low_(low), high_(high), at_low_(at_low), at_high_(at_high) {}

double LogAxis::position(double value) const {
  return at_low_ + std::log(value / low_) / std::log(high_ / low_) * (at_high_ - at_low_);
}

double LogAxis::value(double position) const {
  return low_ * std::pow(high_ / low_, (position - at_low_) / (at_high_ - at_low_));
}

std::vector<LogAxis::Tick> LogAxis::ticks() const {
  const int first = static_cast<int>(std::floor(std::log10(low_))), last = static_cast<int>(std::log10(high_)) + 1;
  const double decades = std::log10(high_ / low_);
  // On long axes only every `stride`-th power is labelled, so that labels do not overlap.
  const int stride = std::max(1, static_cast<int>(decades / 8));
  std::vector<Tick> ticks;
  for (int power = first; power <= last; ++power)
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10.0, power);
      if (value < low_ * (1 - 1e-9) || value > high_ * (1 + 1e-9)) continue;
      const bool is_round = digit == 1 ? power % stride == 0 : decades < 2.9 && (digit == 2 || digit == 5);
      // Less than half a decade may contain no round value, so every tick is labelled.
      const bool is_labelled = is_round || decades < 0.5;
      ticks.push_back({value, is_labelled ? short_number(value) : ""});
    }
  return ticks;
}

std::string short_number(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  std::string number = text;
  // Shortens the exponent: 1e-05 becomes 1e-5.
  const size_t e = number.find('e');
  if (e != std::string::npos) {
    while (e + 2 < number.size() - 1 && number[e + 2] == '0') number.erase(e + 2, 1);
    if (number[e + 1] == '+') number.erase(e + 1, 1);
  }
  return number;
}

std::vector<LogAxis::Tick> linear_ticks(double low, double high, int most) {
  constexpr int kLeastDigits = 3, kMostDigits = 15;
  const double least = (high - low) / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power >= least) step = digit * power;
  const double largest = std::max(std::abs(low), std::abs(high));
  const int distinct = static_cast<int>(std::floor(std::log10(largest)) - std::floor(std::log10(step))) + 1;
  const int digits = std::clamp(distinct, kLeastDigits, kMostDigits);
  std::vector<LogAxis::Tick> ticks;
  // Adding zero turns -0 into 0.
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push_back({i * step, short_number(i * step + 0.0, digits)});
  return ticks;
}

}  // namespace etendue::metrics
