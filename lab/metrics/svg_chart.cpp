#include "metrics/svg_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "metrics/log_axis.h"

namespace etendue::metrics {
namespace {

struct Margins {
  double left, right, top, bottom;
};
constexpr Margins kPage{78, 24, 52, 46}, kPanel{54, 10, 10, 24};
constexpr double kLegendRow = 22;
constexpr double kText = 13, kTitle = 16;
constexpr int kSteps = 25, kPanelSteps = 64;      // places along a curve
constexpr double kLetter = 7, kSlopeWidth = 210;  // of the legend, about

// Told apart without colour vision (M. Okabe and K. Ito, 2008), without the yellow that white swallows.
constexpr std::array<Ink, 7> kInks{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {90, 90, 90}}};

Ink faded(Ink ink, double opacity) { return ink.opacity = opacity, ink; }
// Past the last colour they begin again, dashed.
bool dashed(size_t method) { return method / kInks.size() % 2 == 1; }

struct Limits {
  double low, high;
  bool any = false;

  void add(double v) {
    low = any ? std::min(low, v) : v, high = any ? std::max(high, v) : v;
    any = true;
  }
  // A margin on both sides; something to draw on even where there is nothing to draw.
  Limits widened() const {
    if (!any) return {0.1, 10, false};
    const double margin = std::max(std::pow(high / low, 0.05), 1.05);
    return {low / margin, high * margin, true};
  }
};

class Chart {
 public:
  Chart(std::span<const MethodCurves> methods, const ChartOptions& options)
      : methods_(methods),
        options_(options),
        margins_(options.panel ? kPanel : kPage),
        bands_(bands()),
        x_(x_axis()),
        y_(y_axis()) {
    drawing_.width = options.width;
    drawing_.height = options.height;
    if (!options.panel) drawing_.height += static_cast<int>(kLegendRow * static_cast<double>(methods.size()) + 16);
    drawing_.title = options.title;
  }

  Drawing draw() {
    draw_axes();
    draw_guides();
    for (size_t i = 0; i < bands_.size(); ++i) draw_band(i);
    for (size_t i = 0; i < bands_.size(); ++i) draw_curve(i);
    if (options_.panel) return drawing_;
    for (size_t i = 0; i < bands_.size(); ++i) draw_legend(i);
    return drawing_;
  }

  ChartFrame frame() const { return {margins_.left, right(), margins_.top, bottom(), x_, y_}; }

 private:
  using Bands = std::vector<std::vector<BandPoint>>;

  Bands bands() const {
    Bands all;
    const int steps = options_.panel ? kPanelSteps : kSteps;
    for (const auto& method : methods_) {
      const auto span = span_of(method, options_.along);
      if (!span)
        all.emplace_back();
      else if (span->first < span->last)
        all.push_back(band_of(method, options_.along, options_.kind, log_grid(span->first, span->last, steps)));
      else
        all.push_back(band_of(method, options_.along, options_.kind, std::array{span->first}));
    }
    return all;
  }

  LogAxis x_axis() const {
    Limits limits{};
    for (const auto& band : bands_)
      for (const auto& p : band) limits.add(p.x);
    if (limits.any && options_.reach > 0) limits.add(options_.reach);
    limits = limits.widened();
    return {limits.low, limits.high, margins_.left, options_.width - margins_.right};
  }

  LogAxis y_axis() const {
    Limits limits{};
    for (const auto& band : bands_)
      for (const auto& p : band) limits.add(p.low), limits.add(p.high);
    limits = limits.widened();
    return {limits.low, limits.high, options_.height - margins_.bottom, margins_.top};
  }

  double right() const { return options_.width - margins_.right; }
  double bottom() const { return options_.height - margins_.bottom; }

  void words(double x, double y, const std::string& text, Anchor anchor = Anchor::left) {
    words(x, y, text, anchor, options_.palette.text);
  }
  void words(double x, double y, const std::string& text, Anchor anchor, const Ink& ink, double size = kText) {
    drawing_.shapes.push_back(Words{{x, y}, text, size, ink, anchor});
  }

  void line(Spot from, Spot to, const Ink& ink, bool dash = false) {
    drawing_.shapes.push_back(Stroke{{from, to}, ink, 1, dash});
  }

  void draw_axes() {
    for (const auto& tick : x_.ticks()) {
      const double x = x_.place(tick.value);
      line({x, margins_.top}, {x, bottom()}, tick.label.empty() ? options_.palette.thin_line : options_.palette.line);
      if (!tick.label.empty()) words(x, bottom() + 18, tick.label, Anchor::middle);
    }
    for (const auto& tick : y_.ticks()) {
      const double y = y_.place(tick.value);
      line({margins_.left, y}, {right(), y}, tick.label.empty() ? options_.palette.thin_line : options_.palette.line);
      if (!tick.label.empty()) words(margins_.left - 8, y + 4, tick.label, Anchor::right);
    }
    drawing_.shapes.push_back(Stroke{{{margins_.left, margins_.top}, {margins_.left, bottom()}, {right(), bottom()}},
                                     options_.palette.text,
                                     1,
                                     false});
    const std::string kind = options_.kind == ErrorKind::rmse ? "RMSE" : "relMSE";
    const std::string along = options_.along == Abscissa::seconds ? "seconds" : "samples per pixel";
    // Curves leave the upper right corner free.
    if (options_.panel) return words(right() - 8, margins_.top + 18, kind + " over " + along, Anchor::right);
    words(margins_.left, 20, options_.title, Anchor::left, options_.palette.text, kTitle);
    words(margins_.left, 42, kind);
    words(right(), bottom() + 36, along, Anchor::right);
  }

  void draw_guides() {
    if (options_.reference_error > y_.low() && options_.reference_error < y_.high()) {
      const double y = y_.place(options_.reference_error);
      line({margins_.left, y}, {right(), y}, options_.palette.text, true);
      words(right() - 4, y - 4, "error of the reference", Anchor::right, options_.palette.quiet, kText - 1);
    }
    const double squared = options_.kind == ErrorKind::relmse ? 2 : 1;
    draw_guide(-0.5 * squared, squared > 1 ? "-1" : "-1/2");
    draw_guide(-1 * squared, squared > 1 ? "-2" : "-1");
  }

  // From the upper left corner down with the slope, as far as the axes go.
  void draw_guide(double slope, const std::string& label) {
    const double end = std::min(x_.high(), x_.low() * std::pow(y_.low() / y_.high(), 1 / slope));
    const Spot to{x_.place(end), y_.place(y_.high() * std::pow(end / x_.low(), slope))};
    line({x_.place(x_.low()), y_.place(y_.high())}, to, options_.palette.quiet, true);
    words(to.x - 6, to.y - 6, label, Anchor::right, options_.palette.quiet);
  }

  void draw_band(size_t i) {
    Area area;
    area.ink = faded(ink_of_method(i), 0.18);
    for (const auto& p : bands_[i]) area.points.push_back({x_.place(p.x), y_.place(p.high)});
    for (auto p = bands_[i].rbegin(); p != bands_[i].rend(); ++p)
      area.points.push_back({x_.place(p->x), y_.place(p->low)});
    if (bands_[i].size() > 1) drawing_.shapes.push_back(std::move(area));
  }

  void draw_curve(size_t i) {
    Stroke stroke;
    stroke.ink = ink_of_method(i), stroke.width = 2, stroke.dashed = dashed(i);
    for (const auto& p : bands_[i]) stroke.points.push_back({x_.place(p.x), y_.place(p.median)});
    if (stroke.points.size() > 1) drawing_.shapes.push_back(stroke);
    for (const auto& p : bands_[i])
      if (!options_.panel || &p == &bands_[i].back())
        drawing_.shapes.push_back(Dot{{x_.place(p.x), y_.place(p.median)}, 3, ink_of_method(i), hint(i, p)});
  }

  std::string hint(size_t i, const BandPoint& p) const {
    const std::string unit = options_.along == Abscissa::seconds ? " s" : " spp";
    return methods_[i].name + "\n" + short_number(p.x) + unit + "\n" +
           (options_.kind == ErrorKind::rmse ? "RMSE " : "relMSE ") + short_number(p.median) + " (" +
           short_number(p.low) + " to " + short_number(p.high) + ")";
  }

  void draw_legend(size_t i) {
    const double y = options_.height + 10 + kLegendRow * static_cast<double>(i);
    drawing_.shapes.push_back(Stroke{{{margins_.left, y}, {margins_.left + 28, y}}, ink_of_method(i), 3, dashed(i)});
    std::string name = methods_[i].name;
    const auto longest = static_cast<size_t>((right() - margins_.left - 38 - kSlopeWidth) / kLetter);
    if (name.size() > longest) name = name.substr(0, longest) + "..";
    words(margins_.left + 38, y + 4, name);
    words(right(), y + 4, slope_text(methods_[i]), Anchor::right, options_.palette.quiet);
  }

  std::string slope_text(const MethodCurves& method) const {
    const Figure slope = slope_of(method, options_.along, options_.noise);
    if (!slope.known) return "no error to draw";
    char text[64];
    if (slope.degrees > 0)
      std::snprintf(text, sizeof text, "slope of RMSE %.3f +- %.3f", slope.value, slope.standard_error);
    else
      std::snprintf(text, sizeof text, "slope of RMSE %.3f", slope.value);
    return text;
  }

  std::span<const MethodCurves> methods_;
  const ChartOptions& options_;
  const Margins margins_;
  Bands bands_;
  LogAxis x_, y_;
  Drawing drawing_;
};

}  // namespace

std::string method_color(size_t method) {
  const Ink ink = ink_of_method(method);
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", ink.r, ink.g, ink.b);
  return text;
}

Ink ink_of_method(size_t method) { return kInks[method % kInks.size()]; }

ChartFrame frame_of_chart(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return Chart(methods, options).frame();
}

Drawing chart_of(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return Chart(methods, options).draw();
}

std::string svg_chart(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return svg_of(chart_of(methods, options));
}

}  // namespace etendue::metrics
