#include "advisor/report_numbers.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace etendue::advisor {
namespace {

template <class... T>
std::string printed(const char* format, T... values) {
  char text[48];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// format_percent gives smaller shares two significant digits.
bool is_large(double share) { return share >= 0.0995; }

}  // namespace

std::string number(double value) { return printed("%.3g", value); }

std::string error_number(film::ErrorMeasure measure, double error) {
  return measure == film::ErrorMeasure::rmse ? number(error) : number(100 * error) + " %";
}

std::vector<std::string> percents(std::span<const double> shares) {
  std::vector<std::string> texts;
  std::vector<size_t> large;  // those that are rounded to whole percents
  std::vector<double> whole(shares.size());
  double remainder = 0, rounded_up = 0;
  for (size_t i = 0; i < shares.size(); ++i) {
    if (!is_large(shares[i])) continue;
    large.push_back(i);
    whole[i] = std::floor(100 * shares[i]);
    remainder += 100 * shares[i] - whole[i];
  }
  // The largest remainders are rounded up.
  constexpr double kRounding = 1e-6;
  std::ranges::stable_sort(large, std::greater(),
                           [&](size_t i) { return std::round((100 * shares[i] - whole[i]) / kRounding); });
  for (const size_t i : large)
    if (rounded_up + 1 <= remainder + kRounding) {
      ++whole[i];
      ++rounded_up;
    }
  for (size_t i = 0; i < shares.size(); ++i)
    texts.push_back(is_large(shares[i]) ? printed("%.0f %%", whole[i]) : format_percent(shares[i]));
  return texts;
}

std::string times(double ratio) { return printed(ratio < 9.95 ? "%.1f" : "%.0f", ratio); }

std::string seconds_text(double time) {
  if (time < 99.5) return printed(time < 9.95 ? "%.2g s" : "%.0f s", time);
  const auto s = std::lround(time);
  if (s < 3600) return printed("%ld:%02ld", s / 60, s % 60);
  return printed("%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace etendue::advisor
