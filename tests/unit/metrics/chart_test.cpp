// Convergence charts: valid SVG, logarithmic axes, and the raster version.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metrics/convergence_chart.h"
#include "metrics/log_axis.h"
#include "metrics/text_raster.h"

namespace etendue::test {
namespace {

using namespace metrics;

MethodCurves power_law(const std::string& name, double scale, double slope, int repeats = 3) {
  MethodCurves method{name, {}};
  for (int i = 0; i < repeats; ++i) {
    ErrorCurve curve{i, {}};
    for (const double t : log_grid(0.05, 20, 10)) {
      const double rmse = scale * (1 + 0.1 * i) * std::pow(t, slope);
      curve.points.push_back({t, 64 * t, rmse * rmse, rmse * rmse, 0});
    }
    method.repeats.push_back(std::move(curve));
  }
  return method;
}

// Checks that every element is closed in order, attributes are quoted, and every & starts an entity.
bool well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (size_t i = 0; i < xml.size(); ++i) {
    if (xml[i] == '&' && xml.find(';', i) - i > 6) return false;
    if (xml[i] == '>') return false;
    if (xml[i] != '<') continue;
    size_t end = i + 1;
    for (bool quoted = false; end < xml.size() && (quoted || xml[end] != '>'); ++end) {
      if (xml[end] == '<') return false;
      quoted ^= xml[end] == '"';
    }
    if (end == xml.size()) return false;
    const std::string tag = xml.substr(i + 1, end - i - 1);
    const std::string name = tag.substr(tag[0] == '/', tag.find_first_of(" /", 1) - (tag[0] == '/'));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(name);
    }
    i = end;
  }
  return open.empty();
}

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

bool is_valid_svg(const std::string& svg) {
  return well_formed(svg) && count(svg, "nan") == 0 && count(svg, "inf") == 0;
}

std::string svg_chart(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return to_svg(convergence_chart(methods, options));
}

TEST(WellFormed, AcceptsValidAndRejectsInvalid) {
  EXPECT_TRUE(well_formed("<a b=\"c>d\"><e/>&amp;</a>"));
  EXPECT_FALSE(well_formed("<a><b></a></b>"));
  EXPECT_FALSE(well_formed("<a>"));
  EXPECT_FALSE(well_formed("<a>x & y of many</a>"));
}

TEST(SvgChart, ShowsEveryMethodWithItsSlope) {
  const std::vector<MethodCurves> methods{power_law("path:sampler=sobol", 1, -0.75),
                                          power_law("path:sampler=random", 2, -0.5)};
  const std::string svg = svg_chart(methods, {.title = "Cornell box"});
  EXPECT_TRUE(is_valid_svg(svg)) << svg;
  for (const auto& method : methods) {
    EXPECT_EQ(count(svg, ">" + method.name + "</text>"), 1u);
    EXPECT_EQ(count(svg, "<title>" + method.name), 25u);
  }
  EXPECT_EQ(count(svg, "slope -0.750"), 1u);
  EXPECT_EQ(count(svg, "slope -0.500"), 1u);
  EXPECT_EQ(count(svg, "<polygon"), 2u);
  EXPECT_EQ(count(svg, ">-1/2</text>"), 1u);
  EXPECT_EQ(count(svg, ">-1</text>"), 1u);
  EXPECT_EQ(count(svg, "Cornell box"), 2u);
  EXPECT_EQ(count(svg, ">seconds</text>"), 1u);
}

TEST(SvgChart, SupportsSamplesAndRelativeErrors) {
  const std::vector<MethodCurves> methods{power_law("path", 1, -0.5)};
  const std::string svg = svg_chart(methods, {.title = "", .abscissa = Abscissa::samples, .measure = film::ErrorMeasure::relative});
  EXPECT_TRUE(is_valid_svg(svg));
  EXPECT_EQ(count(svg, ">samples per pixel</text>"), 1u);
  EXPECT_EQ(count(svg, ">relative error</text>"), 1u);
  EXPECT_EQ(count(svg, ">-1</text>"), 1u);
}

TEST(SvgChart, StatesHowManyRepeatsAreComplete) {
  MethodCurves method = power_law("path", 1, -0.5);
  EXPECT_EQ(count(svg_chart(std::vector{method}, {.title = ""}), "repeats"), 0u);
  method.repeats[1].points.resize(4);
  EXPECT_EQ(count(svg_chart(std::vector{method}, {.title = ""}), ">path, median of 2 of 3 repeats</text>"), 1u);
}

TEST(SvgChart, NamesAreEscaped) {
  const std::vector<MethodCurves> methods{power_law("<a href=\"x\">&'\x01", 1, -0.5)};
  const std::string svg = svg_chart(methods, {.title = "R&D <1>"});
  EXPECT_TRUE(is_valid_svg(svg));
  EXPECT_EQ(count(svg, "&lt;a href=&quot;x&quot;&gt;&amp;&#39;</text>"), 1u);
  EXPECT_EQ(count(svg, "R&amp;D &lt;1&gt;"), 2u);
}

TEST(SvgChart, UnusualDataGiveValidCharts) {
  MethodCurves nothing{"nothing", {}}, zero = power_law("zero", 0, -0.5), one = power_law("one", 1, -0.5),
                                       odd = power_law("odd", 1, -0.5), wide = power_law("wide", 1e-12, -6);
  one.repeats.resize(1);
  one.repeats[0].points.resize(1);
  odd.repeats[0].points[2].mse = NAN;
  odd.repeats[1].points[0].seconds = 0;
  odd.repeats[2].points[9].mse = INFINITY;
  for (const auto& method : {nothing, zero, one, odd, wide}) {
    const std::string svg = svg_chart(std::vector{method}, {.title = "t", .reference_error = 1e-3});
    EXPECT_TRUE(is_valid_svg(svg)) << method.name;
    EXPECT_EQ(count(svg, ">" + method.name + "</text>"), 1u);
  }
  EXPECT_TRUE(is_valid_svg(svg_chart({}, {.title = "empty"})));
  EXPECT_TRUE(is_valid_svg(svg_chart(std::vector{nothing, zero, one, odd, wide}, {.title = "all"})));
}

TEST(SvgChart, EverythingIsInsideTheFrame) {
  const std::vector<MethodCurves> methods{power_law("a", 1, -0.5), power_law("b", 3, -1), power_law("c", 1e-3, 0)};
  const Drawing drawing = convergence_chart(methods, {"t", Abscissa::seconds, film::ErrorMeasure::rmse, 900, 520, 2e-3});
  const auto inside = [&](const Point& s) {
    EXPECT_TRUE(s.x >= 0 && s.y >= 0 && s.x <= drawing.width && s.y <= drawing.height) << s.x << " " << s.y;
  };
  for (const auto& shape : drawing.shapes) {
    if (const auto* dot = std::get_if<Dot>(&shape)) inside(dot->at);
    if (const auto* text = std::get_if<metrics::Text>(&shape)) inside(text->at);
    if (const auto* area = std::get_if<Polygon>(&shape)) std::ranges::for_each(area->points, inside);
    if (const auto* stroke = std::get_if<Polyline>(&shape)) std::ranges::for_each(stroke->points, inside);
  }
}

std::vector<std::string> labels(double low, double high) {
  std::vector<std::string> found;
  for (const auto& tick : LogAxis(low, high, 0, 1).ticks())
    if (!tick.label.empty()) found.push_back(tick.label);
  return found;
}

// The labels of the slopes -1/2 and -1, as rectangles of 7 pixels per letter, contain no point of a curve, also where curves
// run along the guides.
TEST(SvgChart, LabelsOfSlopesDoNotTouchCurves) {
  for (const double slope : {-0.3, -0.45, -0.5, -0.7, -1.0, -1.4})
    for (const bool embedded : {false, true}) {
      const std::vector methods{power_law("a", 0.1, slope), power_law("b", 0.11, -0.5), power_law("c", 0.08, -1)};
      ChartOptions options;
      options.embedded = embedded;
      const Drawing drawing = convergence_chart(methods, options);
      size_t labels = 0;
      for (const auto& shape : drawing.shapes) {
        const auto* text = std::get_if<metrics::Text>(&shape);
        if (!text || (text->text != "-1/2" && text->text != "-1")) continue;
        ++labels;
        const double right = text->at.x + 7 * static_cast<double>(text->text.size());
        EXPECT_LE(right, drawing.width);
        for (const auto& other : drawing.shapes) {
          const auto* line = std::get_if<Polyline>(&other);
          if (!line || line->width != 2) continue;
          for (size_t i = 1; i < line->points.size(); ++i)
            for (double t = 0; t <= 1; t += 0.02) {
              const double x = std::lerp(line->points[i - 1].x, line->points[i].x, t);
              const double y = std::lerp(line->points[i - 1].y, line->points[i].y, t);
              const bool inside = x > text->at.x && x < right && y > text->at.y - 9 && y < text->at.y;
              ASSERT_FALSE(inside) << text->text << " at slope " << slope << (embedded ? ", embedded" : "");
            }
        }
      }
      EXPECT_EQ(labels, 2u);
    }
}

TEST(LogAxis, TicksAreRoundNumbers) {
  using Labels = std::vector<std::string>;
  EXPECT_EQ(labels(0.008, 130), (Labels{"0.01", "0.1", "1", "10", "100"}));
  EXPECT_EQ(labels(0.9, 21), (Labels{"1", "2", "5", "10", "20"}));
  EXPECT_EQ(labels(2.5, 5.5), (Labels{"3", "4", "5"}));
  EXPECT_EQ(labels(1e-6, 1e-3), (Labels{"1e-6", "1e-5", "0.0001", "0.001"}));
  EXPECT_LE(labels(1e-30, 1).size(), 12u);
}

TEST(LogAxis, PositionsAreLogarithmic) {
  const LogAxis axis(0.1, 1000, 50, 450);
  EXPECT_NEAR(axis.position(0.1), 50, 1e-9);
  EXPECT_NEAR(axis.position(10), 250, 1e-9);
  EXPECT_NEAR(axis.position(1000), 450, 1e-9);
}

TEST(ShortNumber, HasNoTrailingZeros) {
  for (const auto& [value, text] :
       {std::pair{0.01, "0.01"}, {20.0, "20"}, {1e-5, "1e-5"}, {1e10, "1e10"}, {1.5e-12, "1.5e-12"}})
    EXPECT_EQ(short_number(value), text);
}

TEST(Raster, DrawsShapesWithAntialiasing) {
  Drawing drawing{20, 10, "", {}};
  drawing.shapes.push_back(Polygon{{{2, 2}, {7.5, 2}, {7.5, 8}, {2, 8}}, {0, 0, 0}});
  drawing.shapes.push_back(Polyline{{{10, 5}, {20, 5}}, {255, 0, 0}, 2});
  drawing.shapes.push_back(Polyline{{{NAN, 5}, {20, 5}}, {0, 0, 255}, 20});
  const auto bytes = rasterize(drawing);
  ASSERT_EQ(bytes.size(), 600u);
  const auto at = [&](int x, int y, int c) { return bytes[static_cast<size_t>((y * 20 + x) * 3 + c)]; };
  EXPECT_EQ(at(0, 0, 0), 255);
  EXPECT_EQ(at(4, 4, 0), 0);
  EXPECT_NEAR(at(7, 4, 0), 128, 1);  // half covered
  EXPECT_EQ(at(15, 4, 0), 255);
  EXPECT_EQ(at(15, 4, 1), 0);
  EXPECT_EQ(at(15, 2, 1), 255);
}

// The bounds of the pixels that are darker than half, and their number.
struct DarkPixels {
  int left = 1000, right = -1, top = 1000, bottom = -1, count = 0;
};
DarkPixels dark_pixels(const Drawing& drawing) {
  const auto bytes = rasterize(drawing);
  DarkPixels dark;
  for (int y = 0; y < drawing.height; ++y)
    for (int x = 0; x < drawing.width; ++x) {
      if (bytes[static_cast<size_t>((y * drawing.width + x) * 3)] >= 128) continue;
      dark.left = std::min(dark.left, x);
      dark.right = std::max(dark.right, x);
      dark.top = std::min(dark.top, y);
      dark.bottom = std::max(dark.bottom, y);
      ++dark.count;
    }
  return dark;
}

TEST(Raster, TextStandsOnItsBaseLineAndIsAnchored) {
  const auto drawn = [](Anchor anchor) {
    Drawing drawing{120, 40, "", {}};
    drawing.shapes.push_back(metrics::Text{{60, 30}, "HxH", 20, {0, 0, 0}, anchor});
    return dark_pixels(drawing);
  };
  const DarkPixels left = drawn(Anchor::left), middle = drawn(Anchor::middle), right = drawn(Anchor::right);
  EXPECT_GT(left.count, 60);
  EXPECT_EQ(left.bottom, 29);
  EXPECT_NEAR(left.bottom - left.top + 1, 0.73 * 20, 1.5);  // the height of capitals
  EXPECT_NEAR(left.left, 60, 3);
  EXPECT_NEAR(right.right, 59, 3);
  EXPECT_NEAR((middle.left + middle.right) / 2.0, 60, 1.5);
  EXPECT_NEAR(text_width("HxH", 20), left.right - left.left + 1, 5);
  EXPECT_GT(text_width("HxHxH", 20), 1.5 * text_width("HxH", 20));
}

TEST(Raster, TextMayContainAnyBytes) {
  Drawing drawing{80, 40, "", {}};
  drawing.shapes.push_back(metrics::Text{{5, 30}, "\u00c9\u03b1\xff\xc3", 20, {0, 0, 0}});
  EXPECT_GT(dark_pixels(drawing).count, 40);
}

}  // namespace
}  // namespace etendue::test
