#include "advisor/report_numbers.h"

#include <cmath>
#include <cstdio>

namespace etendue::advisor {
namespace {

template <class... T>
std::string printed(const char* format, T... values) {
  char text[48];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace

std::string number(double value) { return printed("%.3g", value); }

std::string error_number(film::ErrorMeasure measure, double error) {
  return measure == film::ErrorMeasure::rmse ? number(error) : number(100 * error) + " %";
}

std::string percent(double share) { return printed(share >= 0.0995 ? "%.0f %%" : "%.2g %%", 100 * share); }

std::string times(double ratio) { return printed(ratio < 9.95 ? "%.1f" : "%.0f", ratio); }

std::string seconds_text(double time) {
  if (time < 99.5) return printed(time < 9.95 ? "%.2g s" : "%.0f s", time);
  const auto s = std::lround(time);
  if (s < 3600) return printed("%ld:%02ld", s / 60, s % 60);
  return printed("%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace etendue::advisor
