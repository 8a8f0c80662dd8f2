#include "metrics/function_chart.h"

#include <algorithm>
#include <cmath>

#include "metrics/log_axis.h"

namespace etendue::metrics {
namespace {

constexpr double kSmallText = 13, kLargeText = 16, kRowOfLegend = 22;
constexpr double kLeftMargin = 78, kRightMargin = 24, kTopMargin = 52, kBottomMargin = 46;
constexpr double kEmbeddedLeft = 54, kEmbeddedRight = 10, kEmbeddedTop = 10, kEmbeddedBottom = 24;

// A linear or a logarithmic axis.
class FunctionAxis {
 public:
  FunctionAxis(bool logarithmic, double low, double high, double at_low, double at_high)
      : logarithmic_(logarithmic), low_(low), high_(high), at_low_(at_low), at_high_(at_high) {}

  double position(double value) const {
    if (logarithmic_) return LogAxis(low_, high_, at_low_, at_high_).position(value);
    return at_low_ + (value - low_) / (high_ - low_) * (at_high_ - at_low_);
  }
  std::vector<LogAxis::Tick> ticks() const {
    return logarithmic_ ? LogAxis(low_, high_, at_low_, at_high_).ticks() : linear_ticks(low_, high_);
  }
  double low() const { return low_; }

 private:
  bool logarithmic_;
  double low_, high_, at_low_, at_high_;
};

struct AxisRange {
  double low = 0, high = 0;
  bool any = false;

  void add(double value, bool logarithmic) {
    if (!std::isfinite(value) || (logarithmic && value <= 0)) return;
    low = any ? std::min(low, value) : value;
    high = any ? std::max(high, value) : value;
    any = true;
  }
};

class FunctionDrawing {
 public:
  FunctionDrawing(const FunctionChart& chart, const ChartOptions& options)
      : chart_(chart),
        options_(options),
        left_(options.embedded ? kEmbeddedLeft : kLeftMargin),
        right_(options.width - (options.embedded ? kEmbeddedRight : kRightMargin)),
        top_(options.embedded ? kEmbeddedTop : kTopMargin),
        bottom_(options.height - (options.embedded ? kEmbeddedBottom : kBottomMargin)),
        x_(x_axis()),
        y_(y_axis()) {
    drawing_.width = options.width;
    drawing_.height = options.height;
    if (!options.embedded)
      drawing_.height += static_cast<int>(kRowOfLegend * static_cast<double>(chart.curves.size()) + 16);
    drawing_.title = chart.title;
  }

  Drawing draw() {
    draw_grid();
    for (size_t i = 0; i < chart_.curves.size(); ++i) draw_curve(i);
    if (!options_.embedded)
      for (size_t i = 0; i < chart_.curves.size(); ++i) draw_legend(i);
    return drawing_;
  }

 private:
  FunctionAxis x_axis() const {
    AxisRange range;
    for (const FunctionCurve& curve : chart_.curves)
      for (const Point& p : curve.points) range.add(p.x, chart_.logarithmic_x);
    if (!range.any) range = {.low = 0.1, .high = 1};
    if (range.high <= range.low) range.high = range.low + std::max(std::abs(range.low), 1.0);
    return {chart_.logarithmic_x, range.low, range.high, left_, right_};
  }

  FunctionAxis y_axis() const {
    AxisRange range;
    for (const FunctionCurve& curve : chart_.curves) {
      for (const Point& p : curve.points) range.add(p.y, chart_.logarithmic_y);
      for (const Interval& i : curve.band) {
        range.add(i.low, chart_.logarithmic_y);
        range.add(i.high, chart_.logarithmic_y);
      }
      if (curve.style == CurveStyle::bars) range.add(0, chart_.logarithmic_y);
    }
    if (!range.any) range = {.low = 0.1, .high = 1};
    if (chart_.logarithmic_y) {
      const double margin = std::max(std::pow(range.high / range.low, 0.05), 1.05);
      return {true, range.low / margin, range.high * margin, bottom_, top_};
    }
    const double size = range.high > range.low ? range.high - range.low : std::max(std::abs(range.low), 1.0);
    return {false, range.low == 0 ? 0 : range.low - 0.05 * size, range.high + 0.05 * size, bottom_, top_};
  }

  bool can_draw(double x, double y) const {
    return std::isfinite(x) && std::isfinite(y) && (!chart_.logarithmic_x || x > 0) && (!chart_.logarithmic_y || y > 0);
  }
  Point at(double x, double y) const { return {x_.position(x), y_.position(y)}; }

  void add_text(double x, double y, const std::string& text, Anchor anchor, const Color& color,
                double size = kSmallText) {
    drawing_.shapes.emplace_back(Text{.at = {x, y}, .text = text, .size = size, .color = color, .anchor = anchor});
  }
  void add_line(std::vector<Point> points, const Color& color, double width, bool dashed = false) {
    if (points.size() > 1) drawing_.shapes.emplace_back(Polyline{std::move(points), color, width, dashed});
  }

  void draw_grid() {
    const ChartPalette& palette = options_.palette;
    for (const auto& tick : x_.ticks()) {
      const double x = x_.position(tick.value);
      add_line({{x, top_}, {x, bottom_}}, tick.label.empty() ? palette.minor_grid : palette.grid, 1);
      if (!tick.label.empty()) add_text(x, bottom_ + 18, tick.label, Anchor::middle, palette.text);
    }
    for (const auto& tick : y_.ticks()) {
      const double y = y_.position(tick.value);
      add_line({{left_, y}, {right_, y}}, tick.label.empty() ? palette.minor_grid : palette.grid, 1);
      if (!tick.label.empty()) add_text(left_ - 8, y + 4, tick.label, Anchor::right, palette.text);
    }
    add_line({{left_, top_}, {left_, bottom_}, {right_, bottom_}}, palette.text, 1);
    if (options_.embedded) return;
    add_text(left_, 20, chart_.title, Anchor::left, palette.text, kLargeText);
    add_text(left_, 42, chart_.y_label, Anchor::left, palette.text);
    add_text(right_, bottom_ + 36, chart_.x_label, Anchor::right, palette.text);
  }

  void draw_band(const FunctionCurve& curve, Color color) {
    if (curve.band.size() != curve.points.size()) return;
    color.opacity = 0.18;
    Polygon band{.points = {}, .color = color};
    std::vector<Point> lower;
    for (size_t i = 0; i < curve.points.size(); ++i) {
      const double x = curve.points[i].x;
      if (!can_draw(x, curve.band[i].low) || !can_draw(x, curve.band[i].high)) continue;
      band.points.push_back(at(x, curve.band[i].high));
      lower.push_back(at(x, curve.band[i].low));
    }
    std::ranges::reverse(lower);
    band.points.insert(band.points.end(), lower.begin(), lower.end());
    if (band.points.size() > 3) drawing_.shapes.emplace_back(std::move(band));
  }

  void draw_bars(const FunctionCurve& curve, Color color) {
    color.opacity = 0.45;
    for (size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const Point& p = curve.points[i];
      const double next = curve.points[i + 1].x, base = std::max(y_.low(), 0.0);
      if (!can_draw(p.x, p.y) || p.y <= base) continue;
      drawing_.shapes.emplace_back(
          Polygon{.points = {at(p.x, base), at(p.x, p.y), at(next, p.y), at(next, base)}, .color = color});
    }
  }

  void draw_curve(size_t index) {
    const FunctionCurve& curve = chart_.curves[index];
    const Color color = method_color(index);
    draw_band(curve, color);
    if (curve.style == CurveStyle::bars) return draw_bars(curve, color);
    std::vector<Point> line;
    for (const Point& p : curve.points) {
      if (!can_draw(p.x, p.y)) continue;
      line.push_back(at(p.x, p.y));
      if (curve.style == CurveStyle::dots || curve.points.size() <= 40)
        drawing_.shapes.emplace_back(
            Dot{line.back(), 2.5, color, curve.name + "\n" + short_number(p.x) + ": " + short_number(p.y)});
    }
    if (curve.style != CurveStyle::dots) add_line(std::move(line), color, 2, curve.style == CurveStyle::dashed);
  }

  void draw_legend(size_t index) {
    const double y = options_.height + 10 + kRowOfLegend * static_cast<double>(index);
    const FunctionCurve& curve = chart_.curves[index];
    add_line({{left_, y}, {left_ + 28, y}}, method_color(index), 3, curve.style == CurveStyle::dashed);
    add_text(left_ + 38, y + 4, curve.name, Anchor::left, options_.palette.text);
  }

  const FunctionChart& chart_;
  const ChartOptions& options_;
  const double left_, right_, top_, bottom_;
  FunctionAxis x_, y_;
  Drawing drawing_;
};

}  // namespace

Drawing function_drawing(const FunctionChart& chart, const ChartOptions& options) {
  return FunctionDrawing(chart, options).draw();
}

}  // namespace etendue::metrics
