#include "measure/svg_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "measure/log_axis.h"

namespace etendue::measure {
namespace {

constexpr double kLeft = 78, kRight = 24, kTop = 52, kBottom = 46, kLegendRow = 22;
constexpr double kText = 13, kTitle = 16;
constexpr int kSteps = 25;                        // places along a curve
constexpr double kLetter = 7, kSlopeWidth = 210;  // of the legend, about

constexpr Ink kBlack{34, 34, 34}, kGrey{120, 120, 120}, kLine{205, 205, 205}, kThinLine{236, 236, 236};

// Told apart without colour vision (M. Okabe and K. Ito, 2008), without the yellow that white swallows.
constexpr std::array<Ink, 7> kInks{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {90, 90, 90}}};

Ink ink_of(size_t method) { return kInks[method % kInks.size()]; }
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
      : methods_(methods), options_(options), bands_(bands()), x_(x_axis()), y_(y_axis()) {
    drawing_.width = options.width;
    drawing_.height = options.height + static_cast<int>(kLegendRow * static_cast<double>(methods.size()) + 16);
    drawing_.title = options.title;
  }

  Drawing draw() {
    draw_axes();
    draw_guides();
    for (size_t i = 0; i < bands_.size(); ++i) draw_band(i);
    for (size_t i = 0; i < bands_.size(); ++i) draw_curve(i);
    for (size_t i = 0; i < bands_.size(); ++i) draw_legend(i);
    return drawing_;
  }

 private:
  using Bands = std::vector<std::vector<BandPoint>>;

  Bands bands() const {
    Bands all;
    for (const auto& method : methods_) {
      const auto span = span_of(method, options_.along);
      if (!span)
        all.emplace_back();
      else if (span->first < span->last)
        all.push_back(band_of(method, options_.along, options_.kind, log_grid(span->first, span->last, kSteps)));
      else
        all.push_back(band_of(method, options_.along, options_.kind, std::array{span->first}));
    }
    return all;
  }

  LogAxis x_axis() const {
    Limits limits{};
    for (const auto& band : bands_)
      for (const auto& p : band) limits.add(p.x);
    limits = limits.widened();
    return {limits.low, limits.high, kLeft, options_.width - kRight};
  }

  LogAxis y_axis() const {
    Limits limits{};
    for (const auto& band : bands_)
      for (const auto& p : band) limits.add(p.low), limits.add(p.high);
    limits = limits.widened();
    return {limits.low, limits.high, options_.height - kBottom, kTop};
  }

  double right() const { return options_.width - kRight; }
  double bottom() const { return options_.height - kBottom; }

  void words(double x, double y, const std::string& text, Anchor anchor = Anchor::left, const Ink& ink = kBlack,
             double size = kText) {
    drawing_.shapes.push_back(Words{{x, y}, text, size, ink, anchor});
  }

  void line(Spot from, Spot to, const Ink& ink, bool dash = false) {
    drawing_.shapes.push_back(Stroke{{from, to}, ink, 1, dash});
  }

  void draw_axes() {
    for (const auto& tick : x_.ticks()) {
      const double x = x_.place(tick.value);
      line({x, kTop}, {x, bottom()}, tick.label.empty() ? kThinLine : kLine);
      if (!tick.label.empty()) words(x, bottom() + 18, tick.label, Anchor::middle);
    }
    for (const auto& tick : y_.ticks()) {
      const double y = y_.place(tick.value);
      line({kLeft, y}, {right(), y}, tick.label.empty() ? kThinLine : kLine);
      if (!tick.label.empty()) words(kLeft - 8, y + 4, tick.label, Anchor::right);
    }
    drawing_.shapes.push_back(Stroke{{{kLeft, kTop}, {kLeft, bottom()}, {right(), bottom()}}, kBlack, 1, false});
    words(kLeft, 20, options_.title, Anchor::left, kBlack, kTitle);
    words(kLeft, 42, options_.kind == ErrorKind::rmse ? "RMSE" : "relMSE");
    words(right(), bottom() + 36, options_.along == Abscissa::seconds ? "seconds" : "samples per pixel", Anchor::right);
  }

  void draw_guides() {
    if (options_.reference_error > y_.low() && options_.reference_error < y_.high()) {
      const double y = y_.place(options_.reference_error);
      line({kLeft, y}, {right(), y}, kBlack, true);
      words(right() - 4, y - 4, "error of the reference", Anchor::right, kGrey, kText - 1);
    }
    const double squared = options_.kind == ErrorKind::relmse ? 2 : 1;
    draw_guide(-0.5 * squared, squared > 1 ? "-1" : "-1/2");
    draw_guide(-1 * squared, squared > 1 ? "-2" : "-1");
  }

  // From the upper left corner down with the slope, as far as the axes go.
  void draw_guide(double slope, const std::string& label) {
    const double end = std::min(x_.high(), x_.low() * std::pow(y_.low() / y_.high(), 1 / slope));
    const Spot to{x_.place(end), y_.place(y_.high() * std::pow(end / x_.low(), slope))};
    line({x_.place(x_.low()), y_.place(y_.high())}, to, kGrey, true);
    words(to.x - 6, to.y - 6, label, Anchor::right, kGrey);
  }

  void draw_band(size_t i) {
    Area area;
    area.ink = faded(ink_of(i), 0.18);
    for (const auto& p : bands_[i]) area.points.push_back({x_.place(p.x), y_.place(p.high)});
    for (auto p = bands_[i].rbegin(); p != bands_[i].rend(); ++p)
      area.points.push_back({x_.place(p->x), y_.place(p->low)});
    if (bands_[i].size() > 1) drawing_.shapes.push_back(std::move(area));
  }

  void draw_curve(size_t i) {
    Stroke stroke;
    stroke.ink = ink_of(i), stroke.width = 2, stroke.dashed = dashed(i);
    for (const auto& p : bands_[i]) stroke.points.push_back({x_.place(p.x), y_.place(p.median)});
    if (stroke.points.size() > 1) drawing_.shapes.push_back(stroke);
    for (const auto& p : bands_[i])
      drawing_.shapes.push_back(Dot{{x_.place(p.x), y_.place(p.median)}, 3, ink_of(i), hint(i, p)});
  }

  std::string hint(size_t i, const BandPoint& p) const {
    const std::string unit = options_.along == Abscissa::seconds ? " s" : " spp";
    return methods_[i].name + "\n" + short_number(p.x) + unit + "\n" +
           (options_.kind == ErrorKind::rmse ? "RMSE " : "relMSE ") + short_number(p.median) + " (" +
           short_number(p.low) + " to " + short_number(p.high) + ")";
  }

  void draw_legend(size_t i) {
    const double y = options_.height + 10 + kLegendRow * static_cast<double>(i);
    drawing_.shapes.push_back(Stroke{{{kLeft, y}, {kLeft + 28, y}}, ink_of(i), 3, dashed(i)});
    std::string name = methods_[i].name;
    const auto longest = static_cast<size_t>((right() - kLeft - 38 - kSlopeWidth) / kLetter);
    if (name.size() > longest) name = name.substr(0, longest) + "..";
    words(kLeft + 38, y + 4, name);
    words(right(), y + 4, slope_text(methods_[i]), Anchor::right, kGrey);
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
  Bands bands_;
  LogAxis x_, y_;
  Drawing drawing_;
};

}  // namespace

std::string method_color(size_t method) {
  const Ink ink = ink_of(method);
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", ink.r, ink.g, ink.b);
  return text;
}

Drawing chart_of(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return Chart(methods, options).draw();
}

std::string svg_chart(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return svg_of(chart_of(methods, options));
}

}  // namespace etendue::measure
