// Rasterises drawings with antialiasing. Colours are blended in sRGB, as browsers do.
#include <algorithm>
#include <array>
#include <cmath>

#include "metrics/drawing.h"
#include "metrics/text_raster.h"

namespace etendue::metrics {
namespace {

class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width), height_(height), rgb_(static_cast<size_t>(width) * static_cast<size_t>(height) * 3, 255) {}

  void blend(int x, int y, const Color& color, double coverage) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_ || !(coverage > 0)) return;
    double* p = &rgb_[(static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)) * 3];
    const double alpha = std::min(coverage, 1.0) * color.opacity;
    const double target[3] = {static_cast<double>(color.r), static_cast<double>(color.g), static_cast<double>(color.b)};
    for (int c = 0; c < 3; ++c) p[c] += alpha * (target[c] - p[c]);
  }

  // Blends all pixels of a box, clipped to the image, by `coverage` evaluated at pixel centres.
  template <class F>
  void cover(Point low, Point high, const Color& color, F&& coverage) {
    const auto within = [](double v, int most) { return static_cast<int>(std::clamp(v, 0.0, double(most))); };
    const int x1 = within(std::ceil(high.x), width_), y1 = within(std::ceil(high.y), height_);
    for (int y = within(std::floor(low.y), height_); y < y1; ++y)
      for (int x = within(std::floor(low.x), width_); x < x1; ++x)
        blend(x, y, color, coverage(Point{x + 0.5, y + 0.5}));
  }

  int width() const { return width_; }
  int height() const { return height_; }

  std::vector<uint8_t> bytes() const {
    std::vector<uint8_t> out;
    for (const double v : rgb_) out.push_back(static_cast<uint8_t>(v + 0.5));
    return out;
  }

 private:
  int width_, height_;
  std::vector<double> rgb_;
};

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

void paint_segment(Canvas& canvas, const Point& a, const Point& b, double width, const Color& color) {
  const double r = width / 2 + 1;
  canvas.cover({std::min(a.x, b.x) - r, std::min(a.y, b.y) - r}, {std::max(a.x, b.x) + r, std::max(a.y, b.y) + r},
               color, [&](const Point& p) { return width / 2 + 0.5 - distance_to_segment(p, a, b); });
}

void paint(Canvas& canvas, const Polyline& line) {
  if (!is_finite(line.points)) return;
  if (line.dashed) {
    for (const auto& [a, b] : dash_segments(line)) paint_segment(canvas, a, b, line.width, line.color);
    return;
  }
  for (size_t i = 1; i < line.points.size(); ++i)
    paint_segment(canvas, line.points[i - 1], line.points[i], line.width, line.color);
}

// The abscissas at which the outline crosses a horizontal line, from left to right.
std::vector<double> crossings(const std::vector<Point>& points, double y) {
  std::vector<double> xs;
  for (size_t i = 0; i < points.size(); ++i) {
    const Point &a = points[i], &b = points[(i + 1) % points.size()];
    if ((a.y <= y) != (b.y <= y)) xs.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::ranges::sort(xs);
  return xs;
}

// Coverage is exact along x and estimated from kLines scan lines per row of pixels along y.
void paint(Canvas& canvas, const Polygon& polygon) {
  if (!is_finite(polygon.points)) return;
  constexpr int kLines = 4;
  std::vector<double> inside(static_cast<size_t>(canvas.width()));
  const auto [lowest, highest] = std::ranges::minmax(polygon.points, {}, &Point::y);
  const auto row = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, double(canvas.height()))); };
  for (int y = row(std::floor(lowest.y)); y < row(std::ceil(highest.y)); ++y) {
    std::ranges::fill(inside, 0.0);
    for (int i = 0; i < kLines; ++i) {
      const auto xs = crossings(polygon.points, y + (i + 0.5) / kLines);
      for (size_t k = 0; k + 1 < xs.size(); k += 2)
        for (int x = std::max(0, static_cast<int>(xs[k])); x < canvas.width() && x < xs[k + 1]; ++x)
          inside[static_cast<size_t>(x)] +=
              std::max(0.0, std::min(xs[k + 1], x + 1.0) - std::max(xs[k], double(x))) / kLines;
    }
    for (int x = 0; x < canvas.width(); ++x) canvas.blend(x, y, polygon.color, inside[static_cast<size_t>(x)]);
  }
}

void paint(Canvas& canvas, const Dot& d) {
  if (!is_finite(d.at)) return;
  const double r = d.radius + 1;
  canvas.cover({d.at.x - r, d.at.y - r}, {d.at.x + r, d.at.y + r}, d.color,
               [&](const Point& p) { return d.radius + 0.5 - distance(p, d.at); });
}

void paint(Canvas& canvas, const Text& t) {
  if (!is_finite(t.at)) return;
  const double width = text_width(t.text, t.size);
  const double x = t.anchor == Anchor::left ? t.at.x : t.at.x - (t.anchor == Anchor::right ? width : width / 2);
  rasterize_text(t.text, t.size, x, t.at.y,
                 [&](int column, int row, double coverage) { canvas.blend(column, row, t.color, coverage); });
}

}  // namespace

std::vector<uint8_t> rasterize(const Drawing& drawing) {
  Canvas canvas(drawing.width, drawing.height);
  for (const auto& shape : drawing.shapes) std::visit([&](const auto& s) { paint(canvas, s); }, shape);
  return canvas.bytes();
}

}  // namespace etendue::metrics
