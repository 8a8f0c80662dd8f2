#include "metrics/drawing_layout.h"

#include <algorithm>
#include <cmath>

namespace etendue::metrics {
namespace {

void shift(Point& point, const Point& by) {
  point.x += by.x;
  point.y += by.y;
}
void shift(std::vector<Point>& points, const Point& by) {
  for (Point& p : points) shift(p, by);
}
void shift(Polygon& shape, const Point& by) { shift(shape.points, by); }
void shift(Polyline& shape, const Point& by) { shift(shape.points, by); }
void shift(Dot& shape, const Point& by) { shift(shape.at, by); }
void shift(Text& shape, const Point& by) { shift(shape.at, by); }

}  // namespace

void place(Drawing& all, const Drawing& part, const Point& corner) {
  for (auto shape : part.shapes) {
    std::visit([&](auto& s) { shift(s, corner); }, shape);
    all.shapes.push_back(std::move(shape));
  }
  all.width = std::max(all.width, static_cast<int>(std::ceil(corner.x)) + part.width);
  all.height = std::max(all.height, static_cast<int>(std::ceil(corner.y)) + part.height);
  if (!part.title.empty()) all.title += (all.title.empty() ? "" : "; ") + part.title;
}

Drawing stacked(const std::vector<Drawing>& drawings) {
  Drawing all;
  for (const Drawing& drawing : drawings) place(all, drawing, {0, static_cast<double>(all.height)});
  return all;
}

}  // namespace etendue::metrics
