#include "metrics/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "metrics/text_raster.h"

namespace etendue::metrics {
namespace {

constexpr double kDash = 6, kGap = 4;  // pixels; equal to stroke-dasharray below

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", v);
  return text;
}

std::string points_attribute(const std::vector<Point>& points) {
  std::string text;
  for (const Point& p : points) text += (text.empty() ? "" : " ") + number(p.x) + "," + number(p.y);
  return " points=\"" + text + "\"";
}

std::string element(const Polygon& a) {
  if (!is_finite(a.points)) return "";
  return "<polygon" + points_attribute(a.points) + " fill=\"" + css_color(a.color) + "\" fill-opacity=\"" +
         number(a.color.opacity) + "\"/>\n";
}

std::string element(const Polyline& s) {
  if (!is_finite(s.points)) return "";
  return "<polyline" + points_attribute(s.points) + " fill=\"none\" stroke=\"" + css_color(s.color) +
         "\" stroke-width=\"" + number(s.width) + "\"" + (s.dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>\n";
}

// A transparent disk around the dot makes the tooltip easier to hit.
std::string element(const Dot& d) {
  if (!is_finite(d.at)) return "";
  const std::string at = "<circle cx=\"" + number(d.at.x) + "\" cy=\"" + number(d.at.y) + "\" r=\"";
  const std::string dot = at + number(d.radius) + "\" fill=\"" + css_color(d.color) + "\"/>";
  if (d.tooltip.empty()) return dot + "\n";
  return "<g><title>" + escape_markup(d.tooltip) + "</title>" + dot + at + number(d.radius + 6) +
         "\" fill=\"#ffffff\" fill-opacity=\"0\"/></g>\n";
}

std::string element(const Text& t) {
  if (!is_finite(t.at)) return "";
  const char* anchor = t.anchor == Anchor::left ? "start" : t.anchor == Anchor::middle ? "middle" : "end";
  return "<text x=\"" + number(t.at.x) + "\" y=\"" + number(t.at.y) + "\" font-size=\"" + number(t.size) +
         "\" fill=\"" + css_color(t.color) + "\" text-anchor=\"" + anchor + "\">" + escape_markup(t.text) + "</text>\n";
}

}  // namespace

Point interpolate(const Point& a, const Point& b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

bool is_finite(const Point& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

bool is_finite(const std::vector<Point>& points) {
  return !points.empty() && std::ranges::all_of(points, [](const Point& p) { return is_finite(p); });
}

std::string css_color(const Color& color) {
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", color.r, color.g, color.b);
  return text;
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

std::vector<std::array<Point, 2>> dash_segments(const Polyline& line) {
  std::vector<std::array<Point, 2>> dashes;
  double offset = 0;  // arc length at the start of the segment
  for (size_t i = 1; i < line.points.size(); ++i) {
    const Point &a = line.points[i - 1], &b = line.points[i];
    const double length = std::hypot(b.x - a.x, b.y - a.y), period = kDash + kGap;
    for (double start = -std::fmod(offset, period); start < length; start += period) {
      const double from = std::max(start, 0.0), to = std::min(start + kDash, length);
      if (from < to) dashes.push_back({interpolate(a, b, from / length), interpolate(a, b, to / length)});
    }
    offset += length;
  }
  return dashes;
}

std::string escape_markup(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        // XML allows no other control characters.
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') out += c;
    }
  return out;
}

std::string to_svg(const Drawing& drawing) {
  const std::string w = std::to_string(drawing.width);
  const std::string h = std::to_string(drawing.height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
                    "\" viewBox=\"0 0 " + w + " " + h + "\" role=\"img\" aria-label=\"" + escape_markup(drawing.title) +
                    "\" font-family=\"" + kTypefaces + "\">\n<rect width=\"" + w + "\" height=\"" + h +
                    "\" fill=\"#ffffff\"/>\n";
  for (const auto& shape : drawing.shapes) svg += std::visit([](const auto& s) { return element(s); }, shape);
  return svg + "</svg>\n";
}

}  // namespace etendue::metrics
