// Charts of functions: positions on linear and logarithmic axes, bars, bands, and values that cannot be drawn.
#include "metrics/function_chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metrics/drawing_layout.h"

namespace etendue::metrics {
namespace {

template <class Shape>
std::vector<Shape> shapes_of(const Drawing& drawing) {
  std::vector<Shape> list;
  for (const auto& shape : drawing.shapes)
    if (const auto* s = std::get_if<Shape>(&shape)) list.push_back(*s);
  return list;
}

FunctionChart chart_of(FunctionCurve curve) {
  return {.title = "title", .x_label = "x", .y_label = "y", .curves = {std::move(curve)}};
}

TEST(FunctionChart, PointsArePlacedOnTheirAxes) {
  FunctionChart chart = chart_of({.name = "f", .points = {{0, 0}, {1, 1}, {2, 2}}});
  const auto linear = shapes_of<Dot>(function_drawing(chart, {}));
  ASSERT_EQ(linear.size(), 3u);
  EXPECT_NEAR(linear[1].at.x, (linear[0].at.x + linear[2].at.x) / 2, 1e-9);
  EXPECT_GT(linear[0].at.y, linear[2].at.y) << "larger values are higher";
  chart.curves[0].points = {{1, 1}, {10, 10}, {100, 100}};
  chart.logarithmic_x = chart.logarithmic_y = true;
  const auto logarithmic = shapes_of<Dot>(function_drawing(chart, {}));
  EXPECT_NEAR(logarithmic[1].at.x, (logarithmic[0].at.x + logarithmic[2].at.x) / 2, 1e-9);
  EXPECT_NEAR(logarithmic[1].at.y, (logarithmic[0].at.y + logarithmic[2].at.y) / 2, 1e-9);
}

TEST(FunctionChart, ValuesWithoutPositionAreLeftOut) {
  FunctionChart chart = chart_of({.name = "f", .points = {{1, 1}, {2, 0}, {3, -1}, {4, NAN}, {5, INFINITY}, {6, 2}}});
  chart.logarithmic_y = true;
  const Drawing drawing = function_drawing(chart, {});
  EXPECT_EQ(shapes_of<Dot>(drawing).size(), 2u);
  for (const Dot& dot : shapes_of<Dot>(drawing)) EXPECT_TRUE(is_finite(dot.at));
}

TEST(FunctionChart, EmptyAndConstantCurvesAreDrawn) {
  for (const auto& points : {std::vector<Point>{}, std::vector<Point>{{1, 5}}, std::vector<Point>{{1, 0}, {2, 0}}})
    for (const auto& line : shapes_of<Polyline>(function_drawing(chart_of({.name = "f", .points = points}), {})))
      EXPECT_TRUE(is_finite(line.points));
}

TEST(FunctionChart, BarsReachFromZeroToTheirValues) {
  const FunctionChart chart = chart_of({.name = "h", .style = CurveStyle::bars, .points = {{0, 1}, {0.5, 3}, {1, 0}}});
  const auto bars = shapes_of<Polygon>(function_drawing(chart, {}));
  ASSERT_EQ(bars.size(), 2u);
  const auto height = [](const Polygon& p) { return p.points[0].y - p.points[1].y; };
  EXPECT_NEAR(height(bars[1]) / height(bars[0]), 3, 1e-9);
  EXPECT_NEAR(bars[0].points[2].x, bars[1].points[0].x, 1e-9);
}

TEST(FunctionChart, BandsSurroundTheirCurve) {
  const FunctionChart chart = chart_of({.name = "f", .points = {{0, 1}, {1, 2}}, .band = {{0.5, 1.5}, {1.5, 2.5}}});
  const auto bands = shapes_of<Polygon>(function_drawing(chart, {}));
  ASSERT_EQ(bands.size(), 1u);
  EXPECT_EQ(bands[0].points.size(), 4u);
}

TEST(FunctionChart, StackedDrawingsDoNotOverlap) {
  const Drawing one = function_drawing(chart_of({.name = "f", .points = {{0, 0}, {1, 1}}}), {});
  const Drawing two = stacked({one, one});
  EXPECT_EQ(two.height, 2 * one.height);
  EXPECT_EQ(two.shapes.size(), 2 * one.shapes.size());
  const auto dots = shapes_of<Dot>(two);
  EXPECT_NEAR(dots[2].at.y - dots[0].at.y, one.height, 1e-9);
}

}  // namespace
}  // namespace etendue::metrics
