// A drawing as a list of shapes, back to front: what charts are made of before they become SVG, pixels or a panel.
//
// Coordinates are in pixels from the upper left corner. Shapes with a hint show it when the pointer rests on them.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace etendue::metrics {

struct Ink {
  uint8_t r = 0, g = 0, b = 0;
  double opacity = 1;
};

struct Spot {
  double x, y;
};

struct Stroke {
  std::vector<Spot> points;
  Ink ink;
  double width = 1;
  bool dashed = false;
};

struct Area {  // closed
  std::vector<Spot> points;
  Ink ink;
};

struct Dot {
  Spot at;
  double radius;
  Ink ink;
  std::string hint;
};

enum class Anchor { left, middle, right };

struct Words {
  Spot at;  // on the base line
  std::string text;
  double size;  // height of a line
  Ink ink;
  Anchor anchor = Anchor::left;
};

struct Drawing {
  int width = 0, height = 0;
  std::string title;  // for readers that cannot see it
  std::vector<std::variant<Area, Stroke, Dot, Words>> shapes;
};

// The pieces of a dashed line, from end to end: for those who have no dashes of their own.
std::vector<std::array<Spot, 2>> dashes_of(const Stroke& stroke);

// A standing <svg> element, without a declaration: for a file of its own and inside HTML alike. Names are escaped, and
// what is no number never gets in: such shapes are left out.
std::string svg_of(const Drawing& drawing);

// 8-bit sRGB, row by row, on white. Letters are small capitals of 3 x 5 dots (image/bitmap_font.h).
std::vector<uint8_t> raster_of(const Drawing& drawing);

// Text as XML and HTML take it, between tags and in quoted attributes.
std::string escaped(const std::string& text);

}  // namespace etendue::metrics
