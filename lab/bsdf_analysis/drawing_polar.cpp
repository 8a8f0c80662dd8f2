#include <algorithm>
#include <cmath>

#include "bsdf_analysis/drawings.h"
#include "metrics/log_axis.h"

namespace etendue::bsdf_analysis {
namespace {

using metrics::Anchor;
using metrics::Drawing;
using metrics::Point;

constexpr double kLabelSize = 13, kMargin = 26;

double scaled_length(double value, LengthScale scale) {
  return scale == LengthScale::root ? std::pow(value, 0.25) : value;
}

class Polar {
 public:
  Polar(std::span<const Slice> slices, std::span<const std::string> names, const DrawingOptions& options)
      : slices_(slices), names_(names), options_(options) {
    for (const Slice& s : slices)
      for (size_t i = 0; i < s.values.size(); ++i) {
        largest_ = std::max(largest_, value(s, i));
        has_lower_side_ |= std::abs(s.angles[i]) > 90 && value(s, i) > 0;
      }
    const double height = options.height - 2 * kMargin;
    radius_ = std::min(0.5 * options.width - kMargin, has_lower_side_ ? 0.5 * height : height);
    center_ = {0.5 * options.width, has_lower_side_ ? 0.5 * options.height : options.height - kMargin};
    drawing_.width = options.width;
    drawing_.height = options.height;
    drawing_.title = options.title.empty() ? "Slices of f cos in the plane of incidence" : options.title;
  }

  Drawing draw() {
    draw_grid();
    for (size_t i = 0; i < slices_.size(); ++i) draw_slice(i);
    if (!slices_.empty()) draw_view_direction(slices_.front().degrees);
    return drawing_;
  }

 private:
  static double value(const Slice& s, size_t i) { return static_cast<double>(average(s.values[i])); }

  // The side of wo is on the left; `radius` is relative to the rim.
  Point at(double degrees, double radius) const {
    const double a = degrees * 3.14159265358979323846 / 180;
    return {center_.x - std::sin(a) * radius * radius_, center_.y - std::cos(a) * radius * radius_};
  }

  void add_line(std::vector<Point> points, const metrics::Color& color, double width = 1) {
    drawing_.shapes.emplace_back(metrics::Polyline{std::move(points), color, width});
  }

  void draw_grid() {
    const int end = has_lower_side_ ? 180 : 90;
    for (int ring = 1; ring <= 4; ++ring) {
      std::vector<Point> circle;
      for (int a = -end; a <= end; a += 3) circle.push_back(at(a, scaled_length(0.25 * ring, options_.length_scale)));
      add_line(circle, ring == 4 ? options_.palette.grid : options_.palette.minor_grid);
    }
    for (int a = -end; a <= end; a += 30) {
      add_line({at(a, 0), at(a, 1)}, options_.palette.minor_grid);
      if (std::abs(a) > 90 || a == -90 || a == 90) continue;
      const Point s = at(a, 1.04);
      drawing_.shapes.emplace_back(metrics::Text{{s.x, s.y},
                                                 std::to_string(std::abs(a)) + "\u00b0",
                                                 kLabelSize,
                                                 options_.palette.secondary_text,
                                                 a == 0  ? Anchor::middle
                                                 : a > 0 ? Anchor::right
                                                         : Anchor::left});
    }
    add_line({at(90, 1), at(-90, 1)}, options_.palette.grid, 1.5);
    if (largest_ > 0)
      drawing_.shapes.emplace_back(metrics::Text{{options_.width - 6.0, 16},
                                                 "outer circle " + metrics::short_number(largest_) + " /sr",
                                                 kLabelSize,
                                                 options_.palette.secondary_text,
                                                 Anchor::right});
  }

  void draw_slice(size_t index) {
    const Slice& s = slices_[index];
    const metrics::Color color = metrics::method_color(index);
    std::vector<Point> points;
    for (size_t i = 0; i < s.values.size(); ++i)
      points.push_back(at(
          s.angles[i], largest_ > 0 ? scaled_length(std::max(0.0, value(s, i)) / largest_, options_.length_scale) : 0));
    metrics::Color fill = color;
    fill.opacity = 0.12;
    drawing_.shapes.emplace_back(metrics::Polygon{points, fill});
    add_line(points, color, 2);
    if (index < names_.size() && options_.width >= kMinWidthForLegend)
      drawing_.shapes.emplace_back(
          metrics::Text{{6, 16 + 17.0 * static_cast<double>(index)}, names_[index], kLabelSize, color, Anchor::left});
  }

  void draw_view_direction(double degrees) {
    add_line({at(degrees, 0), at(degrees, 1)}, options_.palette.text, 1.5);
    drawing_.shapes.emplace_back(metrics::Dot{at(degrees, 1), 4, options_.palette.text, "wo"});
  }

  std::span<const Slice> slices_;
  std::span<const std::string> names_;
  const DrawingOptions& options_;
  Drawing drawing_;
  double largest_ = 0, radius_ = 1;
  bool has_lower_side_ = false;
  Point center_{};
};

}  // namespace

Drawing polar_drawing(std::span<const Slice> slices, std::span<const std::string> names,
                      const DrawingOptions& options) {
  return Polar(slices, names, options).draw();
}

}  // namespace etendue::bsdf_analysis
