#include "metrics/plane_drawing.h"

#include <cmath>
#include <numbers>

namespace etendue::metrics {
namespace {

constexpr Color kFrameColor{90, 90, 90}, kTextColor{34, 34, 34};

}  // namespace

PlaneDrawing::PlaneDrawing(const PlaneDrawingSettings& settings) : settings_(settings) {
  drawing_.width = settings.width;
  drawing_.height = settings.height;
}

Point PlaneDrawing::position(const Point& p) const {
  const auto& [x, y, width, height, margin, frame] = settings_;
  return {margin + (p.x - x.low) / (x.high - x.low) * (width - 2 * margin),
          height - margin - (p.y - y.low) / (y.high - y.low) * (height - 2 * margin)};
}

void PlaneDrawing::line(const std::vector<Point>& points, const Color& color, double width, bool dashed) {
  Polyline shape{.points = {}, .color = color, .width = width, .dashed = dashed};
  for (const Point& p : points) shape.points.push_back(position(p));
  drawing_.shapes.emplace_back(std::move(shape));
}

void PlaneDrawing::area(const std::vector<Point>& corners, const Color& color) {
  Polygon shape{.points = {}, .color = color};
  for (const Point& p : corners) shape.points.push_back(position(p));
  drawing_.shapes.emplace_back(std::move(shape));
}

void PlaneDrawing::rectangle(Interval x, Interval y, const Color& color) {
  area({{x.low, y.low}, {x.high, y.low}, {x.high, y.high}, {x.low, y.high}}, color);
}

void PlaneDrawing::circle(const Point& center, double radius, const Color& color, double width) {
  std::vector<Point> points;
  for (int i = 0; i <= 64; ++i) {
    const double angle = 2 * std::numbers::pi * i / 64;
    points.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
  }
  line(points, color, width);
}

void PlaneDrawing::dot(const Point& at, const Color& color, double radius) {
  drawing_.shapes.emplace_back(Dot{.at = position(at), .radius = radius, .color = color, .tooltip = {}});
}

void PlaneDrawing::dots(const std::vector<Point>& points, const Color& color, double radius) {
  for (const Point& p : points) dot(p, color, radius);
}

void PlaneDrawing::text(const Point& at, const std::string& text, Anchor anchor, double size) {
  drawing_.shapes.emplace_back(
      Text{.at = position(at), .text = text, .size = size, .color = kTextColor, .anchor = anchor});
}

void PlaneDrawing::grid(int columns, int rows, const Color& color, double width) {
  const auto& [x, y] = std::pair(settings_.x, settings_.y);
  for (int i = 1; i < columns; ++i) {
    const double at = x.low + (x.high - x.low) * i / columns;
    line({{at, y.low}, {at, y.high}}, color, width);
  }
  for (int i = 1; i < rows; ++i) {
    const double at = y.low + (y.high - y.low) * i / rows;
    line({{x.low, at}, {x.high, at}}, color, width);
  }
}

void PlaneDrawing::axes() {
  const auto& [x, y] = std::pair(settings_.x, settings_.y);
  if (y.low <= 0 && y.high >= 0) line({{x.low, 0}, {x.high, 0}}, kFrameColor);
  if (x.low <= 0 && x.high >= 0) line({{0, y.low}, {0, y.high}}, kFrameColor);
}

Drawing PlaneDrawing::finished(std::string title) const {
  Drawing drawing = drawing_;
  drawing.title = std::move(title);
  if (!settings_.frame) return drawing;
  const double m = settings_.margin, right = settings_.width - m, bottom = settings_.height - m;
  drawing.shapes.emplace_back(
      Polyline{.points = {{m, m}, {right, m}, {right, bottom}, {m, bottom}, {m, m}}, .color = kFrameColor, .width = 1});
  return drawing;
}

std::vector<Point> sampled(const std::function<double(double)>& f, double a, double b, int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double x = a + (b - a) * i / (count - 1);
    points.push_back({x, f(x)});
  }
  return points;
}

}  // namespace etendue::metrics
