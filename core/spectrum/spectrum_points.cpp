#include "spectrum/spectrum_points.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/number_text.h"

namespace etendue {
namespace {

constexpr std::string_view kSpace = " \t\r\n,;";

// The number at the start of a text, which is removed.
std::optional<double> take_number(std::string_view& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return number;
}

std::optional<Spectrum::Sample> parse_point(std::string_view text) {
  const auto wavelength = take_number(text);
  if (!wavelength || !text.starts_with(':')) return std::nullopt;
  text.remove_prefix(1);
  const auto value = take_number(text);
  if (!value || !text.empty()) return std::nullopt;
  return Spectrum::Sample{*wavelength, *value};
}

// The part before the next separator, which is removed from the text.
std::string_view take_part(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  const std::string_view part = text.substr(0, text.find_first_of(kSpace));
  text.remove_prefix(part.size());
  return part;
}

void append_simplified(std::span<const Spectrum::Sample> points, double tolerance,
                       std::vector<Spectrum::Sample>& result) {
  const auto &first = points.front(), &last = points.back();
  size_t farthest = 0;
  double distance = tolerance;
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const double t = (points[i].wavelength - first.wavelength) / (last.wavelength - first.wavelength);
    const double difference = std::abs(points[i].value - std::lerp(first.value, last.value, t));
    if (difference <= distance) continue;
    distance = difference;
    farthest = i;
  }
  if (farthest > 0) {
    append_simplified(points.first(farthest + 1), tolerance, result);
    append_simplified(points.subspan(farthest), tolerance, result);
  } else {
    result.push_back(last);
  }
}

}  // namespace

bool is_point_list(std::string_view text) { return take_number(text).has_value() && text.starts_with(':'); }

Result<std::vector<Spectrum::Sample>> parse_points(std::string_view text) {
  std::vector<Spectrum::Sample> points;
  for (std::string_view part = take_part(text); !part.empty(); part = take_part(text)) {
    const auto point = parse_point(part);
    if (!point)
      return input_error("'" + std::string(part) +
                         "' is not a point; give wavelengths in nm and values, such as 400:0.2 700:1");
    points.push_back(*point);
  }
  if (points.size() < 2) return input_error("a spectrum has two points at least, such as 400:0.2 700:1");
  return points;
}

Result<Spectrum> spectrum_of_points(std::string_view text) {
  auto points = parse_points(text);
  if (!points) return points.error();
  return Spectrum::piecewise_linear(std::move(*points));
}

std::string text_of_points(std::span<const Spectrum::Sample> points) {
  std::string text;
  for (const auto& [wavelength, value] : points) {
    if (!text.empty()) text += ' ';
    text += format_number(std::round(10 * wavelength) / 10, 6) + ':' + format_number(value, 5);
  }
  return text;
}

std::vector<Spectrum::Sample> simplified_points(std::span<const Spectrum::Sample> points, double tolerance) {
  if (points.size() < 3) return {points.begin(), points.end()};
  std::vector<Spectrum::Sample> result{points.front()};
  append_simplified(points, tolerance, result);
  return result;
}

}  // namespace etendue
