#include "metrics/convergence_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "metrics/log_axis.h"

namespace etendue::metrics {
namespace {

struct Margins {
  double left, right, top, bottom;
};
constexpr Margins kMargins{78, 24, 52, 46};
constexpr Margins kEmbeddedMargins{54, 10, 24, 24};
constexpr double kLegendRow = 22;
constexpr double kText = 13, kTitle = 16;
constexpr int kSteps = 25, kEmbeddedSteps = 64;        // points along a curve
constexpr double kLetterWidth = 7, kSlopeWidth = 210;  // approximate text widths in the legend, pixels

// Distinguishable with colour vision deficiency [Okabe and Ito 2008]; without their yellow, which is too faint on
// white.
constexpr std::array<Color, 7> kMethodColors{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {90, 90, 90}}};

Color with_opacity(Color color, double opacity) {
  color.opacity = opacity;
  return color;
}

bool is_dashed(size_t method) { return method / kMethodColors.size() % 2 == 1; }

struct Limits {
  double low, high;
  bool any = false;

  void add(double v) {
    low = any ? std::min(low, v) : v;
    high = any ? std::max(high, v) : v;
    any = true;
  }
  // Adds a margin on both sides. Without any value the axis covers two decades.
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
        margins_(options.embedded ? kEmbeddedMargins : kMargins),
        bands_(bands()),
        x_(x_axis()),
        y_(y_axis()) {
    drawing_.width = options.width;
    drawing_.height = options.height;
    if (!options.embedded) drawing_.height += static_cast<int>(kLegendRow * static_cast<double>(methods.size()) + 16);
    drawing_.title = options.title;
  }

  Drawing draw() {
    draw_axes();
    draw_guides();
    for (size_t i = 0; i < bands_.size(); ++i) draw_band(i);
    for (size_t i = 0; i < bands_.size(); ++i) draw_curve(i);
    if (options_.embedded) return drawing_;
    for (size_t i = 0; i < bands_.size(); ++i) draw_legend(i);
    return drawing_;
  }

  ChartFrame frame() const { return {margins_.left, right(), margins_.top, bottom(), x_, y_}; }

 private:
  using Bands = std::vector<std::vector<BandPoint>>;

  Bands bands() const {
    Bands all;
    const int steps = options_.embedded ? kEmbeddedSteps : kSteps;
    for (const auto& method : methods_) {
      const auto range = abscissa_range(method, options_.abscissa, options_.measure);
      if (!range)
        all.emplace_back();
      else if (range->first < range->last)
        all.push_back(
            error_band(method, options_.abscissa, options_.measure, log_grid(range->first, range->last, steps)));
      else
        all.push_back(error_band(method, options_.abscissa, options_.measure, std::array{range->first}));
    }
    return all;
  }

  LogAxis x_axis() const {
    Limits limits{};
    for (const auto& band : bands_)
      for (const auto& p : band) limits.add(p.x);
    if (limits.any && options_.x_extent > 0) limits.add(options_.x_extent);
    limits = limits.widened();
    return {limits.low, limits.high, margins_.left, options_.width - margins_.right};
  }

  LogAxis y_axis() const {
    Limits limits{};
    for (const auto& band : bands_)
      for (const auto& p : band) {
        limits.add(p.low);
        limits.add(p.high);
      }
    limits = limits.widened();
    return {limits.low, limits.high, options_.height - margins_.bottom, margins_.top};
  }

  double right() const { return options_.width - margins_.right; }
  double bottom() const { return options_.height - margins_.bottom; }

  void add_text(double x, double y, const std::string& text, Anchor anchor = Anchor::left) {
    add_text(x, y, text, anchor, options_.palette.text);
  }
  void add_text(double x, double y, const std::string& text, Anchor anchor, const Color& color, double size = kText) {
    drawing_.shapes.push_back(Text{.at = {x, y}, .text = text, .size = size, .color = color, .anchor = anchor});
  }

  void add_line(Point from, Point to, const Color& color, bool dashed = false) {
    drawing_.shapes.push_back(Polyline{.points = {from, to}, .color = color, .width = 1, .dashed = dashed});
  }

  void draw_axes() {
    for (const auto& tick : x_.ticks()) {
      const double x = x_.position(tick.value);
      add_line({x, margins_.top}, {x, bottom()},
               tick.label.empty() ? options_.palette.minor_grid : options_.palette.grid);
      if (!tick.label.empty()) add_text(x, bottom() + 18, tick.label, Anchor::middle);
    }
    for (const auto& tick : y_.ticks()) {
      const double y = y_.position(tick.value);
      add_line({margins_.left, y}, {right(), y},
               tick.label.empty() ? options_.palette.minor_grid : options_.palette.grid);
      if (!tick.label.empty()) add_text(margins_.left - 8, y + 4, tick.label, Anchor::right);
    }
    drawing_.shapes.push_back(
        Polyline{.points = {{margins_.left, margins_.top}, {margins_.left, bottom()}, {right(), bottom()}},
                 .color = options_.palette.text});
    const std::string kind = error_label();
    const std::string x_label = options_.abscissa == Abscissa::seconds ? "seconds"
                                : options_.work_label.empty()          ? "samples per pixel"
                                                                       : options_.work_label;
    // Above the plot area, where no curve and no slope is.
    if (options_.embedded) return add_text(right(), margins_.top - 8, kind + " over " + x_label, Anchor::right);
    add_text(margins_.left, 20, options_.title, Anchor::left, options_.palette.text, kTitle);
    add_text(margins_.left, 42, kind);
    add_text(right(), bottom() + 36, x_label, Anchor::right);
  }

  void draw_guides() {
    if (options_.reference_error > y_.low() && options_.reference_error < y_.high()) {
      const double y = y_.position(options_.reference_error);
      add_line({margins_.left, y}, {right(), y}, options_.palette.text, true);
      add_text(right() - 4, y - 4, "error of the reference", Anchor::right, options_.palette.secondary_text, kText - 1);
    }
    draw_guide(-0.5, "-1/2");
    draw_guide(-1, "-1");
  }

  // A line with the given slope from the upper left corner to the border of the plot area.
  void draw_guide(double slope, const std::string& label) {
    const double end = std::min(x_.high(), x_.low() * std::pow(y_.low() / y_.high(), 1 / slope));
    const Point to{x_.position(end), y_.position(y_.high() * std::pow(end / x_.low(), slope))};
    const Point from{x_.position(x_.low()), y_.position(y_.high())};
    add_line(from, to, options_.palette.secondary_text, true);
    const Point at = place_of_label(from, to, kLetterWidth * static_cast<double>(label.size()));
    add_text(at.x, at.y, label, Anchor::left, options_.palette.secondary_text);
  }

  // Where a text of this width above a descending line is farthest from the curves. Distances of more than three lines of
  // text count alike, and the end of the line is preferred.
  Point place_of_label(const Point& from, const Point& to, double width) const {
    constexpr int kPlaces = 32;
    constexpr double kGap = 6, kFarEnough = 3 * kText;
    Point best{right() - width, margins_.top + kText};
    double most = -1;
    for (int i = kPlaces - 1; i >= 0; --i) {
      const double t = (i + 0.5) / kPlaces;
      const Point corner{std::lerp(from.x, to.x, t) + kGap, std::lerp(from.y, to.y, t) - kGap};
      if (corner.x + width > right() || corner.y - kText < margins_.top) continue;
      const double distance = std::min(distance_to_curves({corner.x + 0.5 * width, corner.y - 0.4 * kText}), kFarEnough);
      if (distance <= most) continue;
      most = distance;
      best = corner;
    }
    return best;
  }

  double distance_to_curves(const Point& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& band : bands_)
      for (size_t i = 0; i < band.size(); ++i) {
        const auto at = [&](const BandPoint& b) { return Point{x_.position(b.x), y_.position(b.median)}; };
        least = std::min(least, distance_to_segment(p, at(band[i > 0 ? i - 1 : 0]), at(band[i])));
      }
    return least;
  }

  void draw_band(size_t i) {
    Polygon band;
    band.color = with_opacity(method_color(i), 0.18);
    for (const auto& p : bands_[i]) band.points.push_back({x_.position(p.x), y_.position(p.high)});
    for (auto p = bands_[i].rbegin(); p != bands_[i].rend(); ++p)
      band.points.push_back({x_.position(p->x), y_.position(p->low)});
    if (bands_[i].size() > 1) drawing_.shapes.push_back(std::move(band));
  }

  void draw_curve(size_t i) {
    Polyline line;
    line.color = method_color(i);
    line.width = 2;
    line.dashed = is_dashed(i);
    for (const auto& p : bands_[i]) line.points.push_back({x_.position(p.x), y_.position(p.median)});
    if (line.points.size() > 1) drawing_.shapes.push_back(line);
    for (const auto& p : bands_[i])
      if (!options_.embedded || &p == &bands_[i].back())
        drawing_.shapes.push_back(Dot{{x_.position(p.x), y_.position(p.median)}, 3, method_color(i), tooltip(i, p)});
  }

  std::string tooltip(size_t i, const BandPoint& p) const {
    const std::string unit = options_.abscissa == Abscissa::seconds ? " s"
                             : options_.work_label.empty()          ? " spp"
                                                                    : " " + options_.work_label;
    return methods_[i].name + "\n" + short_number(p.x) + unit + "\n" + error_label() + " " +
           error_number(p.median) + " (" + error_number(p.low) + " to " + error_number(p.high) + ")";
  }

  std::string error_label() const {
    return options_.error_label.empty() ? film::measure_label(options_.measure) : options_.error_label;
  }

  std::string error_number(double error) const {
    return options_.measure == film::ErrorMeasure::rmse ? short_number(error) : short_number(100 * error) + " %";
  }

  void draw_legend(size_t i) {
    const double y = options_.height + 10 + kLegendRow * static_cast<double>(i);
    drawing_.shapes.push_back(
        Polyline{{{margins_.left, y}, {margins_.left + 28, y}}, method_color(i), 3, is_dashed(i)});
    std::string name = methods_[i].name;
    const auto max_length = static_cast<size_t>((right() - margins_.left - 38 - kSlopeWidth) / kLetterWidth);
    if (name.size() > max_length) name = name.substr(0, max_length) + "..";
    const size_t complete = complete_repeats(methods_[i], options_.abscissa).repeats.size();
    if (complete > 0 && complete < methods_[i].repeats.size())
      name +=
          ", median of " + std::to_string(complete) + " of " + std::to_string(methods_[i].repeats.size()) + " repeats";
    add_text(margins_.left + 38, y + 4, name);
    const std::string text = bands_[i].empty() ? "no error to draw" : slope_text(methods_[i]);
    add_text(right(), y + 4, text, Anchor::right, options_.palette.secondary_text);
  }

  // Empty if one point does not determine a slope.
  std::string slope_text(const MethodCurves& method) const {
    const Estimate slope =
        slope_of(complete_repeats(method, options_.abscissa), options_.abscissa, options_.noise, options_.measure);
    if (!slope.known) return "";
    char text[64];
    if (slope.degrees > 0)
      std::snprintf(text, sizeof text, "slope %.3f \u00b1 %.3f", slope.value, slope.standard_error);
    else
      std::snprintf(text, sizeof text, "slope %.3f", slope.value);
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

Color method_color(size_t method) { return kMethodColors[method % kMethodColors.size()]; }

ChartFrame chart_frame(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return Chart(methods, options).frame();
}

Drawing convergence_chart(std::span<const MethodCurves> methods, const ChartOptions& options) {
  return Chart(methods, options).draw();
}

}  // namespace etendue::metrics
