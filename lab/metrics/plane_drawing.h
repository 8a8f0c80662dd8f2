// Drawings in the coordinates of a plane: points, lines and areas on a rectangle, with equal or different scales along
// the axes. For charts with labelled axes see function_chart.h.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "metrics/drawing.h"
#include "metrics/function_chart.h"

namespace etendue::metrics {

struct PlaneDrawingSettings {
  Interval x{0, 1}, y{0, 1};      // the visible part; y points upwards
  int width = 260, height = 260;  // pixels
  double margin = 10;             // pixels around the visible part
  bool frame = true;
};

class PlaneDrawing {
 public:
  explicit PlaneDrawing(const PlaneDrawingSettings& settings = {});

  Point position(const Point& p) const;

  // Widths and radii are in pixels.
  void line(const std::vector<Point>& points, const Color& color, double width = 1.2, bool dashed = false);
  void area(const std::vector<Point>& corners, const Color& color);
  void rectangle(Interval x, Interval y, const Color& color);
  void circle(const Point& center, double radius, const Color& color, double width = 1);  // radius in x coordinates
  void dot(const Point& at, const Color& color, double radius = 2);
  void dots(const std::vector<Point>& points, const Color& color, double radius = 2);
  void text(const Point& at, const std::string& text, Anchor anchor = Anchor::left, double size = 13);
  // A grid of equal cells over the visible part.
  void grid(int columns, int rows, const Color& color, double width = 1);
  // The axes x = 0 and y = 0, where they are visible.
  void axes();

  Drawing finished(std::string title) const;

 private:
  PlaneDrawingSettings settings_;
  Drawing drawing_;
};

// f at `count` >= 2 equidistant points from a to b.
std::vector<Point> sampled(const std::function<double(double)>& f, double a, double b, int count = 200);

}  // namespace etendue::metrics
