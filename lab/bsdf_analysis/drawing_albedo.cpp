#include <algorithm>
#include <cmath>

#include "bsdf_analysis/drawings.h"
#include "metrics/log_axis.h"

namespace etendue::bsdf_analysis {
namespace {

using metrics::Anchor;
using metrics::Drawing;
using metrics::Spot;

constexpr double kText = 13, kLeft = 44, kRight = 14, kTop = 12, kBottom = 26;
// Above this curves leave the drawing: what matters is that they are above one.
constexpr double kCeiling = 2;

class Chart {
 public:
  Chart(std::span<const std::vector<Albedo>> curves, std::span<const std::string> names, const Look& look)
      : curves_(curves), names_(names), look_(look) {
    double largest = 1;
    for (const auto& curve : curves)
      for (const Albedo& a : curve) largest = std::max(largest, static_cast<double>(max_component(a.value)));
    top_ = largest > 1.001 ? std::min(1.1 * largest, kCeiling) : 1.05;
    drawing_.width = look.width, drawing_.height = look.height;
    drawing_.title = "Albedo over the angle of the light";
  }

  Drawing draw() {
    draw_axes();
    for (size_t i = 0; i < curves_.size(); ++i) draw_curve(i);
    return drawing_;
  }

 private:
  Spot at(double degrees, double value) const {
    const double x = kLeft + degrees / 90 * (look_.width - kLeft - kRight);
    const double y = look_.height - kBottom - std::clamp(value / top_, 0.0, 1.0) * (look_.height - kTop - kBottom);
    return {x, y};
  }
  void stroke(std::vector<Spot> points, const metrics::Ink& ink, double width, bool dashed = false) {
    drawing_.shapes.emplace_back(metrics::Stroke{std::move(points), ink, width, dashed});
  }
  void words(Spot spot, const std::string& text, const metrics::Ink& ink, Anchor anchor) {
    drawing_.shapes.emplace_back(metrics::Words{spot, text, kText, ink, anchor});
  }

  void draw_axes() {
    if (top_ > 1.05) {
      const metrics::Ink too_much{213, 94, 0, 0.1};
      drawing_.shapes.emplace_back(metrics::Area{{at(0, 1), at(90, 1), at(90, top_), at(0, top_)}, too_much});
    }
    for (int degrees = 0; degrees <= 90; degrees += 15) {
      stroke({at(degrees, 0), at(degrees, top_)}, look_.palette.thin_line, 1);
      const Spot s = at(degrees, 0);
      words({s.x, s.y + 18}, std::to_string(degrees) + "\u00b0", look_.palette.quiet, Anchor::middle);
    }
    const double step = top_ > 1.5 ? 0.5 : 0.25;
    for (double v = 0; v <= top_ + 1e-9; v += step) {
      stroke({at(0, v), at(90, v)}, v == 1 ? look_.palette.line : look_.palette.thin_line, v == 1 ? 1.5 : 1);
      const Spot s = at(0, v);
      words({s.x - 6, s.y + 4}, metrics::short_number(v), look_.palette.quiet, Anchor::right);
    }
  }

  void draw_curve(size_t index) {
    const auto& curve = curves_[index];
    const metrics::Ink ink = metrics::ink_of_method(index);
    std::vector<Spot> low, high;
    std::vector<Spot> points;
    for (const Albedo& a : curve) {
      const double v = static_cast<double>(average(a.value));
      points.push_back(at(a.degrees, v));
      low.push_back(at(a.degrees, v - 2 * a.error)), high.push_back(at(a.degrees, v + 2 * a.error));
    }
    std::reverse(high.begin(), high.end());
    low.insert(low.end(), high.begin(), high.end());
    metrics::Ink faded = ink;
    faded.opacity = 0.2;
    drawing_.shapes.emplace_back(metrics::Area{low, faded});
    stroke(points, ink, 2);
    for (const Albedo& a : curve) {
      const double v = static_cast<double>(average(a.value));
      drawing_.shapes.emplace_back(metrics::Dot{
          at(a.degrees, v), 2, ink, metrics::short_number(a.degrees) + "\u00b0: " + metrics::short_number(v)});
    }
    if (index < names_.size() && look_.width >= kRoomForNames)
      words({kLeft + 8, look_.height - kBottom - 8 - 17.0 * static_cast<double>(names_.size() - 1 - index)},
            names_[index], ink, Anchor::left);
  }

  std::span<const std::vector<Albedo>> curves_;
  std::span<const std::string> names_;
  const Look& look_;
  Drawing drawing_;
  double top_ = 1;
};

}  // namespace

Drawing albedo_drawing(std::span<const std::vector<Albedo>> curves, std::span<const std::string> names,
                       const Look& look) {
  return Chart(curves, names, look).draw();
}

}  // namespace etendue::bsdf_analysis
