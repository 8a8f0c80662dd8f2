#include "base/number_text.h"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace etendue {
namespace {

// Three significant digits without an exponent; `value` is in [0, 1000) up to rounding.
std::string three_digits(double value) {
  return format_text(value < 9.995 ? "%.2f" : value < 99.95 ? "%.1f" : "%.0f", value);
}

// "2 h 5 min", or "2 h" if the smaller unit is zero.
std::string two_units(long larger, const char* larger_unit, long smaller, const char* smaller_unit) {
  std::string text = format_text("%ld %s", larger, larger_unit);
  if (smaller > 0) text += format_text(" %ld %s", smaller, smaller_unit);
  return text;
}

}  // namespace

std::string format_text(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(length > 0 ? static_cast<size_t>(length) : 0, '\0');
  if (length > 0) std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

std::string format_number(double value, int digits) { return format_text("%.*g", digits, value); }

std::string format_percent(double fraction) {
  return format_text(std::abs(fraction) < 0.0995 ? "%.2g %%" : "%.0f %%", 100 * fraction);
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  if (seconds <= 0) return "0 s";
  if (seconds < 0.0995) return format_text("%.2g ms", 1000 * seconds);
  if (seconds < 9.95) return format_text("%.2g s", seconds);
  const long s = std::lround(seconds);
  if (s < 60) return format_text("%ld s", s);
  if (s < 3600) return two_units(s / 60, "min", s % 60, "s");
  const long minutes = std::lround(seconds / 60);
  if (minutes < 24 * 60) return two_units(minutes / 60, "h", minutes % 60, "min");
  const long hours = std::lround(seconds / 3600);
  return two_units(hours / 24, "d", hours % 24, "h");
}

std::string format_bytes(uint64_t bytes) {
  if (bytes < 1024) return format_text("%d B", static_cast<int>(bytes));
  constexpr std::array<const char*, 4> kUnits{"KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes) / 1024;
  size_t unit = 0;
  while (value >= 1023.5 && unit + 1 < kUnits.size()) {
    value /= 1024;
    ++unit;
  }
  return format_text(value < 9.95 ? "%.1f %s" : "%.0f %s", value, kUnits[unit]);
}

std::string format_count(uint64_t count, const char* singular, const char* plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

std::string format_rate(double per_second, const char* unit) {
  constexpr std::array<const char*, 4> kPrefixes{"", "k", "M", "G"};
  size_t prefix = 0;
  while (per_second >= 999.5 && prefix + 1 < kPrefixes.size()) {
    per_second /= 1000;
    ++prefix;
  }
  return three_digits(per_second) + " " + kPrefixes[prefix] + unit + "/s";
}

}  // namespace etendue
