#include <algorithm>
#include <cmath>

#include "bsdf_analysis/drawings.h"
#include "metrics/log_axis.h"

namespace etendue::bsdf_analysis {
namespace {

using metrics::Anchor;
using metrics::Drawing;
using metrics::Spot;

constexpr double kText = 13, kMargin = 26;

double length_of(double share, Length length) { return length == Length::root ? std::pow(share, 0.25) : share; }

class Polar {
 public:
  Polar(std::span<const Slice> slices, std::span<const std::string> names, const Look& look)
      : slices_(slices), names_(names), look_(look) {
    for (const Slice& s : slices)
      for (size_t i = 0; i < s.values.size(); ++i) {
        largest_ = std::max(largest_, value(s, i));
        below_ |= std::abs(s.angles[i]) > 90 && value(s, i) > 0;
      }
    const double height = look.height - 2 * kMargin;
    radius_ = std::min(0.5 * look.width - kMargin, below_ ? 0.5 * height : height);
    middle_ = {0.5 * look.width, below_ ? 0.5 * look.height : look.height - kMargin};
    drawing_.width = look.width, drawing_.height = look.height;
    drawing_.title = "Slices of f cos in the plane of incidence";
  }

  Drawing draw() {
    draw_web();
    for (size_t i = 0; i < slices_.size(); ++i) draw_slice(i);
    if (!slices_.empty()) draw_eye(slices_.front().degrees);
    return drawing_;
  }

 private:
  static double value(const Slice& s, size_t i) { return static_cast<double>(average(s.values[i])); }

  // The eye's side is on the left.
  Spot at(double degrees, double share) const {
    const double a = degrees * 3.14159265358979323846 / 180;
    return {middle_.x - std::sin(a) * share * radius_, middle_.y - std::cos(a) * share * radius_};
  }

  void stroke(std::vector<Spot> points, const metrics::Ink& ink, double width = 1) {
    drawing_.shapes.emplace_back(metrics::Stroke{std::move(points), ink, width, false});
  }

  void draw_web() {
    const int end = below_ ? 180 : 90;
    for (int ring = 1; ring <= 4; ++ring) {
      std::vector<Spot> circle;
      for (int a = -end; a <= end; a += 3) circle.push_back(at(a, length_of(0.25 * ring, look_.length)));
      stroke(circle, ring == 4 ? look_.palette.line : look_.palette.thin_line);
    }
    for (int a = -end; a <= end; a += 30) {
      stroke({at(a, 0), at(a, 1)}, look_.palette.thin_line);
      if (std::abs(a) > 90 || a == -90 || a == 90) continue;
      const Spot s = at(a, 1.05);
      drawing_.shapes.emplace_back(metrics::Words{{s.x, s.y + 0.3 * kText},
                                                  std::to_string(std::abs(a)) + "\u00b0",
                                                  kText,
                                                  look_.palette.quiet,
                                                  Anchor::middle});
    }
    stroke({at(90, 1), at(-90, 1)}, look_.palette.line, 1.5);
    if (largest_ > 0)
      drawing_.shapes.emplace_back(metrics::Words{{look_.width - 6.0, 16},
                                                  "rim " + metrics::short_number(largest_) + " /sr",
                                                  kText,
                                                  look_.palette.quiet,
                                                  Anchor::right});
  }

  void draw_slice(size_t index) {
    const Slice& s = slices_[index];
    const metrics::Ink ink = metrics::ink_of_method(index);
    std::vector<Spot> points;
    for (size_t i = 0; i < s.values.size(); ++i)
      points.push_back(
          at(s.angles[i], largest_ > 0 ? length_of(std::max(0.0, value(s, i)) / largest_, look_.length) : 0));
    metrics::Ink faded = ink;
    faded.opacity = 0.12;
    drawing_.shapes.emplace_back(metrics::Area{points, faded});
    stroke(points, ink, 2);
    if (index < names_.size() && look_.width >= kRoomForNames)
      drawing_.shapes.emplace_back(
          metrics::Words{{6, 16 + 17.0 * static_cast<double>(index)}, names_[index], kText, ink, Anchor::left});
  }

  void draw_eye(double degrees) {
    stroke({at(degrees, 0), at(degrees, 1)}, look_.palette.text, 1.5);
    drawing_.shapes.emplace_back(metrics::Dot{at(degrees, 1), 4, look_.palette.text, "the eye"});
  }

  std::span<const Slice> slices_;
  std::span<const std::string> names_;
  const Look& look_;
  Drawing drawing_;
  double largest_ = 0, radius_ = 1;
  bool below_ = false;
  Spot middle_{};
};

}  // namespace

Drawing polar_drawing(std::span<const Slice> slices, std::span<const std::string> names, const Look& look) {
  return Polar(slices, names, look).draw();
}

}  // namespace etendue::bsdf_analysis
