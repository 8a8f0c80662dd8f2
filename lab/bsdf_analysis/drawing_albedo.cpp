#include <algorithm>
#include <cmath>

#include "bsdf_analysis/drawings.h"
#include "metrics/log_axis.h"

namespace etendue::bsdf_analysis {
namespace {

using metrics::Anchor;
using metrics::Drawing;
using metrics::Point;

constexpr double kTextSize = 13;
constexpr double kLeft = 44, kRight = 14, kTop = 24, kBottom = 26;  // margins
constexpr double kMaxAxisEnd = 2;                                   // curves are clipped above this value

class Chart {
 public:
  Chart(std::span<const std::vector<Albedo>> curves, std::span<const std::string> names, const DrawingOptions& options)
      : curves_(curves), names_(names), options_(options) {
    double largest = 1;
    for (const auto& curve : curves)
      for (const Albedo& a : curve) largest = std::max(largest, static_cast<double>(max_component(a.value)));
    axis_end_ = largest > 1.001 ? std::min(1.1 * largest, kMaxAxisEnd) : 1.05;
    drawing_.width = options.width;
    drawing_.height = options.height;
    drawing_.title = "Albedo over the angle of incidence";
  }

  Drawing draw() {
    draw_axes();
    for (size_t i = 0; i < curves_.size(); ++i) draw_curve(i);
    return drawing_;
  }

 private:
  Point at(double degrees, double value) const {
    const double x = kLeft + degrees / 90 * (options_.width - kLeft - kRight);
    const double y =
        options_.height - kBottom - std::clamp(value / axis_end_, 0.0, 1.0) * (options_.height - kTop - kBottom);
    return {x, y};
  }
  void add_line(std::vector<Point> points, const metrics::Color& color, double width) {
    drawing_.shapes.emplace_back(metrics::Polyline{std::move(points), color, width});
  }
  void add_text(Point position, const std::string& text, const metrics::Color& color, Anchor anchor) {
    drawing_.shapes.emplace_back(metrics::Text{position, text, kTextSize, color, anchor});
  }

  void draw_axes() {
    add_text({kLeft, 14}, "albedo", options_.palette.secondary_text, Anchor::left);
    if (axis_end_ > 1.05) {
      constexpr metrics::Color kOverOne{213, 94, 0, 0.1};
      drawing_.shapes.emplace_back(
          metrics::Polygon{{at(0, 1), at(90, 1), at(90, axis_end_), at(0, axis_end_)}, kOverOne});
    }
    for (int degrees = 0; degrees <= 90; degrees += 15) {
      add_line({at(degrees, 0), at(degrees, axis_end_)}, options_.palette.minor_grid, 1);
      const Point p = at(degrees, 0);
      add_text({p.x, p.y + 18}, std::to_string(degrees) + "\u00b0", options_.palette.secondary_text, Anchor::middle);
    }
    const double step = axis_end_ > 1.5 ? 0.5 : 0.25;
    for (double v = 0; v <= axis_end_ + 1e-9; v += step) {
      add_line({at(0, v), at(90, v)}, v == 1 ? options_.palette.grid : options_.palette.minor_grid, v == 1 ? 1.5 : 1);
      const Point p = at(0, v);
      add_text({p.x - 6, p.y + 4}, metrics::short_number(v), options_.palette.secondary_text, Anchor::right);
    }
  }

  void draw_curve(size_t index) {
    const auto& curve = curves_[index];
    const metrics::Color color = metrics::method_color(index);
    // The band covers two standard errors on either side.
    std::vector<Point> band, upper, points;
    for (const Albedo& a : curve) {
      const double v = static_cast<double>(average(a.value));
      points.push_back(at(a.degrees, v));
      band.push_back(at(a.degrees, v - 2 * a.error));
      upper.push_back(at(a.degrees, v + 2 * a.error));
    }
    std::reverse(upper.begin(), upper.end());
    band.insert(band.end(), upper.begin(), upper.end());
    metrics::Color band_color = color;
    band_color.opacity = 0.2;
    drawing_.shapes.emplace_back(metrics::Polygon{band, band_color});
    add_line(points, color, 2);
    for (const Albedo& a : curve) {
      const double v = static_cast<double>(average(a.value));
      drawing_.shapes.emplace_back(metrics::Dot{
          at(a.degrees, v), 2, color, metrics::short_number(a.degrees) + "\u00b0: " + metrics::short_number(v)});
    }
    if (index < names_.size() && options_.width >= kMinWidthForLegend)
      add_text({kLeft + 8, options_.height - kBottom - 8 - 17.0 * static_cast<double>(names_.size() - 1 - index)},
               names_[index], color, Anchor::left);
  }

  std::span<const std::vector<Albedo>> curves_;
  std::span<const std::string> names_;
  const DrawingOptions& options_;
  Drawing drawing_;
  double axis_end_ = 1;
};

}  // namespace

Drawing albedo_drawing(std::span<const std::vector<Albedo>> curves, std::span<const std::string> names,
                       const DrawingOptions& options) {
  return Chart(curves, names, options).draw();
}

}  // namespace etendue::bsdf_analysis
