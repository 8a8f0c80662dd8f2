#include "metrics/pareto_chart.h"

#include <algorithm>
#include <cmath>

namespace etendue::metrics {
namespace {

constexpr double kLabelSize = 12, kLabelGap = 7;

// Curves of one point, with which convergence_chart draws dots.
std::vector<MethodCurves> ends_of(std::span<const MethodCurves> methods, const ChartOptions& options) {
  std::vector<MethodCurves> ends;
  for (const MethodCurves& method : methods) ends.push_back({method.name, {}});
  for (const ParetoPoint& p : pareto_points(methods, options.abscissa, options.measure)) {
    const double square = p.error * p.error;
    const ErrorPoint end{.seconds = p.x, .spp = p.x, .mse = square, .relmse = square, .displayed_mse = square};
    ends[p.method].repeats.push_back({.repeat = 0, .points = {end}});
  }
  return ends;
}

ChartOptions without_extent(ChartOptions options) {
  options.x_extent = 0;
  return options;
}

// The best points by increasing cost.
std::vector<ParetoPoint> front_of(std::vector<ParetoPoint> points) {
  std::erase_if(points, [](const ParetoPoint& p) { return !p.is_best; });
  std::ranges::sort(points, {}, &ParetoPoint::x);
  return points;
}

// To the side of the dot with more space.
Text label_of(const std::string& name, const Point& dot, const ChartFrame& frame, const ChartPalette& palette) {
  const bool to_the_left = dot.x > 0.5 * (frame.left + frame.right);
  return {.at = {dot.x + (to_the_left ? -kLabelGap : kLabelGap), dot.y - kLabelGap},
          .text = name,
          .size = kLabelSize,
          .color = palette.text,
          .anchor = to_the_left ? Anchor::right : Anchor::left};
}

// Whether two labels would cover each other. Widths are estimates.
bool overlap(const Text& a, const Text& b) {
  constexpr double kLetterWidth = 7;
  const auto left = [](const Text& t) {
    return t.anchor == Anchor::right ? t.at.x - kLetterWidth * static_cast<double>(t.text.size()) : t.at.x;
  };
  const auto right = [&](const Text& t) { return left(t) + kLetterWidth * static_cast<double>(t.text.size()); };
  return std::abs(a.at.y - b.at.y) < kLabelSize && left(a) < right(b) && left(b) < right(a);
}

}  // namespace

std::vector<ParetoPoint> pareto_points(std::span<const MethodCurves> methods, Abscissa abscissa,
                                       film::ErrorMeasure measure) {
  std::vector<ParetoPoint> points;
  for (size_t i = 0; i < methods.size(); ++i) {
    const CurveEnd end = curve_end(methods[i], abscissa, measure);
    const double x = abscissa == Abscissa::seconds ? end.seconds : end.spp;
    if (end.point && x > 0 && end.point->median > 0) points.push_back({.method = i, .x = x, .error = end.point->median});
  }
  for (ParetoPoint& p : points)
    p.is_best = std::ranges::none_of(points, [&](const ParetoPoint& other) {
      return other.x <= p.x && other.error <= p.error && (other.x < p.x || other.error < p.error);
    });
  return points;
}

ChartFrame pareto_frame(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return chart_frame(ends_of(methods, options), without_extent(options));
}

Drawing pareto_chart(std::span<const MethodCurves> methods, const ChartOptions& options) {
  const std::vector<MethodCurves> ends = ends_of(methods, options);
  Drawing drawing = convergence_chart(ends, without_extent(options));
  const ChartFrame frame = chart_frame(ends, without_extent(options));
  const auto front = front_of(pareto_points(methods, options.abscissa, options.measure));
  std::vector<Text> labels;
  Polyline line{.points = {}, .color = options.palette.secondary_text, .width = 1.5};
  for (const ParetoPoint& p : front) {
    const Point at{frame.x.position(p.x), frame.y.position(p.error)};
    if (!line.points.empty()) line.points.push_back({at.x, line.points.back().y});
    line.points.push_back(at);
    const Text label = label_of(methods[p.method].name, at, frame, options.palette);
    if (std::ranges::any_of(labels, [&](const Text& other) { return overlap(label, other); })) continue;
    labels.push_back(label);
    drawing.shapes.emplace_back(label);
  }
  if (line.points.size() > 1) drawing.shapes.emplace_back(std::move(line));
  return drawing;
}

}  // namespace etendue::metrics
