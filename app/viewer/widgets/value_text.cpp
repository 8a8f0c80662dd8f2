#include "viewer/widgets/value_text.h"

#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <ctime>

namespace etendue::viewer {

std::string formatted(const char* format, ...) {
  char text[1001];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(seconds);
  if (whole >= 3600) return formatted("%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  return formatted("%lld:%02lld", whole / 60, whole % 60);
}

std::string remaining_time(double seconds, double low, double high) {
  constexpr double kLongest = 100 * 3600;
  if (seconds > kLongest) return "days left";
  const std::string from = clock_text(std::max(low, 0.0));
  const std::string to = high > kLongest ? std::string("days") : clock_text(high);
  return from == to ? clock_text(seconds) + " left" : from + " to " + to + " left";
}

std::string date_text(int64_t seconds) {
  if (seconds == 0) return "";
  const auto time = static_cast<std::time_t>(seconds);
  std::tm local{};
  localtime_r(&time, &local);
  char text[32] = "";
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
  return text;
}

std::string label_of_name(std::string name) {
  if (name.empty()) return name;
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  if (const size_t dash = name.find('-'); dash != std::string::npos) name[dash] = ' ';
  if (name.ends_with(" id")) name.replace(name.size() - 2, 2, "ID");
  return name;
}

std::string with_superscripts(std::string unit) {
  if (const size_t position = unit.find("^2"); position != std::string::npos) unit.replace(position, 2, "\u00b2");
  return unit;
}

}  // namespace etendue::viewer
