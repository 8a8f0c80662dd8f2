// Vector drawings: a list of shapes, back to front. Charts are drawings; they are written as SVG or PNG, or shown in a
// panel.
//
// Coordinates are in pixels from the upper left corner. A shape with a tooltip shows it under the pointer.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace etendue::metrics {

struct Color {  // sRGB
  uint8_t r = 0, g = 0, b = 0;
  double opacity = 1;
};

// "#rrggbb"; the opacity is not part of it.
std::string css_color(const Color& color);

struct Point {
  double x, y;
};

Point interpolate(const Point& a, const Point& b, double t);
bool is_finite(const Point& point);
// Whether there are points, and all are finite.
bool is_finite(const std::vector<Point>& points);

struct Polyline {
  std::vector<Point> points;
  Color color;
  double width = 1;
  bool dashed = false;
};

struct Polygon {  // closed and filled
  std::vector<Point> points;
  Color color;
};

struct Dot {
  Point at;
  double radius;
  Color color;
  std::string tooltip;
};

enum class Anchor { left, middle, right };

struct Text {
  Point at;  // on the base line
  std::string text;
  double size;  // line height
  Color color;
  Anchor anchor = Anchor::left;
};

struct Drawing {
  int width = 0, height = 0;
  std::string title;  // description for screen readers
  std::vector<std::variant<Polygon, Polyline, Dot, Text>> shapes;
};

// The distance of a point from the line between two points.
double distance_to_segment(const Point& p, const Point& a, const Point& b);

// The end points of the dashes of a dashed line, for back ends that cannot draw dashed lines.
std::vector<std::array<Point, 2>> dash_segments(const Polyline& line);

// An <svg> element without an XML declaration, valid as a file and inside HTML. Text is escaped; shapes with
// coordinates that are not finite are left out.
std::string to_svg(const Drawing& drawing);

// 8-bit sRGB, row by row, on white. Text is drawn with FreeType, in the typeface of the SVG.
std::vector<uint8_t> rasterize(const Drawing& drawing);

// Escapes text for XML and HTML, between tags and in quoted attributes.
std::string escape_markup(const std::string& text);

}  // namespace etendue::metrics
