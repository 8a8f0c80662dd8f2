#include "metrics/log_axis.h"

#include <cmath>
#include <cstdio>

namespace etendue::metrics {

LogAxis::LogAxis(double low, double high, double at_low, double at_high)
    : low_(low), high_(high), at_low_(at_low), at_high_(at_high) {}

double LogAxis::place(double value) const {
  return at_low_ + std::log(value / low_) / std::log(high_ / low_) * (at_high_ - at_low_);
}

double LogAxis::value(double place) const {
  return low_ * std::pow(high_ / low_, (place - at_low_) / (at_high_ - at_low_));
}

std::vector<LogAxis::Tick> LogAxis::ticks() const {
  const int first = static_cast<int>(std::floor(std::log10(low_))), last = static_cast<int>(std::log10(high_)) + 1;
  const double decades = std::log10(high_ / low_);
  // So many powers that their labels would touch are thinned out.
  const int apart = std::max(1, static_cast<int>(decades / 8));
  std::vector<Tick> ticks;
  for (int power = first; power <= last; ++power)
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10.0, power);
      if (value < low_ * (1 - 1e-9) || value > high_ * (1 + 1e-9)) continue;
      const bool round = digit == 1 ? power % apart == 0 : decades < 2.9 && (digit == 2 || digit == 5);
      // Less than a decade may hold no round value at all.
      const bool labelled = round || decades < 0.5;
      ticks.push_back({value, labelled ? short_number(value) : ""});
    }
  return ticks;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  std::string number = text;
  // 1e-05 is 1e-5 to a reader.
  const size_t e = number.find('e');
  if (e != std::string::npos) {
    while (e + 2 < number.size() - 1 && number[e + 2] == '0') number.erase(e + 2, 1);
    if (number[e + 1] == '+') number.erase(e + 1, 1);
  }
  return number;
}

}  // namespace etendue::metrics
