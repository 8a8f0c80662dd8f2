#include <cmath>
#include <cstdio>

#include "metrics/drawing.h"

namespace etendue::metrics {
namespace {

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", v);
  return text;
}

bool finite(const Spot& s) { return std::isfinite(s.x) && std::isfinite(s.y); }

bool finite(const std::vector<Spot>& spots) {
  for (const Spot& s : spots)
    if (!finite(s)) return false;
  return !spots.empty();
}

std::string color(const Ink& ink) {
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", ink.r, ink.g, ink.b);
  return text;
}

std::string points(const std::vector<Spot>& spots) {
  std::string text;
  for (const Spot& s : spots) text += (text.empty() ? "" : " ") + number(s.x) + "," + number(s.y);
  return " points=\"" + text + "\"";
}

std::string element(const Area& a) {
  if (!finite(a.points)) return "";
  return "<polygon" + points(a.points) + " fill=\"" + color(a.ink) + "\" fill-opacity=\"" + number(a.ink.opacity) +
         "\"/>\n";
}

std::string element(const Stroke& s) {
  if (!finite(s.points)) return "";
  return "<polyline" + points(s.points) + " fill=\"none\" stroke=\"" + color(s.ink) + "\" stroke-width=\"" +
         number(s.width) + "\"" + (s.dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>\n";
}

// The hint is caught by a disk that is easier to hit than the dot.
std::string element(const Dot& d) {
  if (!finite(d.at)) return "";
  const std::string at = "<circle cx=\"" + number(d.at.x) + "\" cy=\"" + number(d.at.y) + "\" r=\"";
  const std::string dot = at + number(d.radius) + "\" fill=\"" + color(d.ink) + "\"/>";
  if (d.hint.empty()) return dot + "\n";
  return "<g><title>" + escaped(d.hint) + "</title>" + dot + at + number(d.radius + 6) +
         "\" fill=\"#ffffff\" fill-opacity=\"0\"/></g>\n";
}

std::string element(const Words& w) {
  if (!finite(w.at)) return "";
  const char* anchor = w.anchor == Anchor::left ? "start" : w.anchor == Anchor::middle ? "middle" : "end";
  return "<text x=\"" + number(w.at.x) + "\" y=\"" + number(w.at.y) + "\" font-size=\"" + number(w.size) +
         "\" fill=\"" + color(w.ink) + "\" text-anchor=\"" + anchor + "\">" + escaped(w.text) + "</text>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
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
        // XML knows no other control characters.
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') out += c;
    }
  return out;
}

std::string svg_of(const Drawing& drawing) {
  const std::string w = std::to_string(drawing.width), h = std::to_string(drawing.height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
                    "\" viewBox=\"0 0 " + w + " " + h + "\" role=\"img\" aria-label=\"" + escaped(drawing.title) +
                    "\" font-family=\"sans-serif\">\n<rect width=\"" + w + "\" height=\"" + h +
                    "\" fill=\"#ffffff\"/>\n";
  for (const auto& shape : drawing.shapes) svg += std::visit([](const auto& s) { return element(s); }, shape);
  return svg + "</svg>\n";
}

}  // namespace etendue::metrics
