#include "viewer/panels/convergence_plot.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "metrics/pareto_chart.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/convergence_task.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/chart_painter.h"
#include "viewer/widgets/ui_context.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using metrics::MethodCurves;

metrics::Color with_opacity(metrics::Color color, double opacity) {
  color.opacity *= opacity;
  return color;
}

metrics::ChartOptions panel_chart_options(const UiContext& ui, const ConvergenceTask& task, const ImVec2& size) {
  metrics::ChartOptions options = task.chart_options();
  options.width = static_cast<int>(size.x / ui.scale);
  options.height = static_cast<int>(size.y / ui.scale);
  options.embedded = true;
  const metrics::Color border = chart_color(ImGui::GetStyleColorVec4(ImGuiCol_Border));
  options.palette = {.text = chart_color(ui.theme.text),
                     .secondary_text = chart_color(ui.theme.secondary_text),
                     .grid = border,
                     .minor_grid = with_opacity(border, 0.45)};
  const auto* snapshot = task.result();
  const bool equal_time = snapshot && snapshot->rule == bench::Rule::equal_time;
  if (snapshot && equal_time == (options.abscissa == metrics::Abscissa::seconds))
    options.x_extent = equal_time ? snapshot->seconds : snapshot->samples;
  return options;
}

// The error of one method at the x coordinate of the cross-hair.
struct Reading {
  size_t method = 0;
  metrics::BandPoint point;
};

std::vector<Reading> read_curves(const std::vector<MethodCurves>& curves, const metrics::ChartOptions& options,
                                 double x) {
  std::vector<Reading> readings;
  for (size_t i = 0; i < curves.size(); ++i) {
    const auto points = metrics::error_band(curves[i], options.abscissa, options.measure, std::array{x});
    if (!points.empty()) readings.push_back({.method = i, .point = points.front()});
  }
  return readings;
}

// "path, sobol  0.0123  0.0118 to 0.0131  x1.32": the last number is relative to the smallest error.
std::string reading_text(const MethodCurves& curves, const Reading& reading, double smallest, size_t name_width) {
  const auto& p = reading.point;
  std::string text = curves.name;
  text.resize(name_width, ' ');
  text += formatted("  %-7.3g", p.median);
  if (curves.repeats.size() > 1) text += formatted(" %6.3g to %-6.3g", p.low, p.high);
  return text + formatted(" \u00d7%.2f", p.median / smallest);
}

// A cross-hair at the pointer and a box with the errors of all methods there.
class CrossHair {
 public:
  CrossHair(const UiContext& ui, const ImVec2& corner, const std::vector<MethodCurves>& curves,
            const metrics::ChartOptions& options)
      : ui_(ui),
        corner_(corner),
        curves_(curves),
        options_(options),
        frame_(metrics::chart_frame(curves, options)),
        scale_(ui.scale) {}

  void draw() {
    const double x = (ui_.input.mouse.x - corner_.x) / scale_;
    const double y = (ui_.input.mouse.y - corner_.y) / scale_;
    if (x < frame_.left || x > frame_.right || y < frame_.top || y > frame_.bottom) return;
    readings_ = read_curves(curves_, options_, frame_.x.value(x));
    draw_lines(x, y);
    const bool over_time = options_.abscissa == metrics::Abscissa::seconds;
    std::string title = metrics::short_number(frame_.x.value(x)) + (over_time ? " s" : " spp");
    if (readings_.empty()) title += ", " + metrics::short_number(frame_.y.value(y));
    draw_box(x, title, lines());
  }

 private:
  ImVec2 at(double x, double y) const {
    return {corner_.x + static_cast<float>(x) * scale_, corner_.y + static_cast<float>(y) * scale_};
  }

  // Without a curve at x, a horizontal line shows the y coordinate.
  void draw_lines(double x, double y) const {
    const ImU32 color = ImGui::GetColorU32(ui_.theme.secondary_text);
    draw_->AddLine(at(x, frame_.top), at(x, frame_.bottom), color);
    if (readings_.empty()) draw_->AddLine(at(frame_.left, y), at(frame_.right, y), color);
    for (const auto& r : readings_)
      draw_->AddCircleFilled(at(x, frame_.y.position(r.point.median)), 3.5f * scale_,
                             color_of(metrics::method_color(r.method)));
  }

  std::vector<std::string> lines() const {
    size_t name_width = 0;
    double smallest = INFINITY;
    for (const auto& r : readings_) {
      name_width = std::max(name_width, curves_[r.method].name.size());
      smallest = std::min(smallest, r.point.median);
    }
    std::vector<std::string> list;
    for (const auto& r : readings_) list.push_back(reading_text(curves_[r.method], r, smallest, name_width));
    return list;
  }

  // The number of points of the curves that a box would cover.
  int covered_points(const ImVec2& box, const ImVec2& size) const {
    constexpr int kSteps = 16;
    int count = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double x = (box.x + size.x * static_cast<float>(i) / kSteps - corner_.x) / scale_;
      for (const auto& r : read_curves(curves_, options_, frame_.x.value(x))) {
        const float y = at(0, frame_.y.position(r.point.median)).y;
        if (y > box.y && y < box.y + size.y) ++count;
      }
    }
    return count;
  }

  // The box is on the side of the line with more space, at the top or at the bottom, where it covers less.
  ImVec2 box_corner(double x, const ImVec2& size, float gap) const {
    const ImVec2 min = at(frame_.left, frame_.top);
    const ImVec2 max = at(frame_.right, frame_.bottom);
    const float line_x = at(x, 0).x;
    const bool to_the_right = x < 0.5 * (frame_.left + frame_.right);
    const float left = to_the_right ? line_x + gap : line_x - size.x - gap;
    const float clamped = std::clamp(left, min.x, std::max(min.x, max.x - size.x));
    const ImVec2 top{clamped, min.y + gap};
    const ImVec2 bottom{clamped, max.y - size.y - gap};
    return covered_points(bottom, size) < covered_points(top, size) ? bottom : top;
  }

  void draw_box(double x, const std::string& title, const std::vector<std::string>& text) const {
    constexpr float kRounding = 4;
    ImFont* font = ui_.fonts.small;
    const float font_size = font->FontSize;
    const float gap = font_size * 0.6f;
    const float line_height = font_size + 3 * scale_;
    const float swatch = font_size * 1.2f;
    const auto width_of = [&](const std::string& s) { return font->CalcTextSizeA(font_size, 1e6f, 0, s.c_str()).x; };
    float width = width_of(title);
    for (const auto& line : text) width = std::max(width, width_of(line) + swatch);
    const ImVec2 size{width + 2 * gap, line_height * static_cast<float>(text.size() + 1) + gap};
    const ImVec2 corner = box_corner(x, size, gap);
    const ImVec2 end{corner.x + size.x, corner.y + size.y};
    draw_->AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_PopupBg), kRounding);
    draw_->AddRect(corner, end, ImGui::GetColorU32(ImGuiCol_Border), kRounding);
    ImVec2 next{corner.x + gap, corner.y + gap * 0.5f};
    draw_->AddText(font, font_size, next, ImGui::GetColorU32(ui_.theme.secondary_text), title.c_str());
    for (size_t i = 0; i < text.size(); ++i) {
      next.y += line_height;
      draw_->AddRectFilled({next.x, next.y + font_size * 0.2f}, {next.x + font_size * 0.7f, next.y + font_size * 0.9f},
                           color_of(metrics::method_color(readings_[i].method)), 2);
      draw_->AddText(font, font_size, {next.x + swatch, next.y}, ImGui::GetColorU32(ui_.theme.text), text[i].c_str());
    }
  }

  const UiContext& ui_;
  const ImVec2 corner_;
  const std::vector<MethodCurves>& curves_;
  const metrics::ChartOptions& options_;
  const metrics::ChartFrame frame_;
  const float scale_;
  std::vector<Reading> readings_;
  ImDrawList* const draw_ = ImGui::GetWindowDrawList();
};

void draw_placeholder(const UiContext& ui, bool running, const ImVec2& corner, const ImVec2& size) {
  const char* text = running ? "Waiting for the first results."
                             : "Start comparison renders the methods in turns and plots their errors here.";
  const float wrap_width = std::min(size.x, 24 * ImGui::GetFontSize());
  const ImVec2 text_size = ImGui::CalcTextSize(text, nullptr, false, wrap_width);
  ImGui::GetWindowDrawList()->AddText(
      ImGui::GetFont(), ImGui::GetFontSize(),
      {corner.x + (size.x - text_size.x) * 0.5f, corner.y + (size.y - text_size.y) * 0.5f},
      ImGui::GetColorU32(ui.theme.secondary_text), text, nullptr, wrap_width);
}

// In the lower left corner, which is free because errors decrease.
void draw_outdated_label(const UiContext& ui, const ImVec2& corner, const metrics::ChartFrame& frame) {
  const float font_size = ui.fonts.small->FontSize;
  const ImVec2 at{corner.x + static_cast<float>(frame.left + 8) * ui.scale,
                  corner.y + static_cast<float>(frame.bottom - 6) * ui.scale - font_size};
  ImGui::GetWindowDrawList()->AddText(ui.fonts.small, font_size, at, ImGui::GetColorU32(ui.theme.warning),
                                      "outdated: before the last edit");
}

std::string pareto_text(const ConvergenceTask& task, const metrics::ParetoPoint& point,
                        const metrics::ChartOptions& options) {
  const bool over_time = options.abscissa == metrics::Abscissa::seconds;
  return method_label(task.result()->methods[point.method].name) + "\n" + metrics::short_number(point.x) +
         (over_time ? " s, " : " spp, ") + film::error_text(options.measure, point.error) +
         (point.is_best ? "\nNo method is better in both" : "") + "\nClick to use this method";
}

// Buttons on the dots. Returns the method that was clicked.
std::optional<size_t> draw_points(UiContext& ui, const ConvergenceTask& task, const std::vector<MethodCurves>& curves,
                                  const metrics::ChartOptions& options, const ImVec2& corner) {
  const metrics::ChartFrame frame = metrics::pareto_frame(curves, options);
  const float reach = 7 * ui.scale;
  std::optional<size_t> chosen;
  for (const metrics::ParetoPoint& p : metrics::pareto_points(curves, options.abscissa, options.measure)) {
    const ImVec2 at{corner.x + static_cast<float>(frame.x.position(p.x)) * ui.scale,
                    corner.y + static_cast<float>(frame.y.position(p.error)) * ui.scale};
    ImGui::SetCursorScreenPos({at.x - reach, at.y - reach});
    const std::string number = std::to_string(p.method);
    if (ImGui::InvisibleButton(("##point" + number).c_str(), {2 * reach, 2 * reach})) chosen = p.method;
    ui.items.add("compare.point." + number);
    if (!ImGui::IsItemHovered()) continue;
    ImGui::GetWindowDrawList()->AddCircle(at, reach, ImGui::GetColorU32(ui.theme.text));
    tooltip(ui, pareto_text(task, p, options));
  }
  return chosen;
}

// Returns the method that was clicked.
std::optional<size_t> draw_pareto_chart(UiContext& ui, const ConvergenceTask& task,
                                        const std::vector<MethodCurves>& curves, const metrics::ChartOptions& options,
                                        const ImVec2& corner) {
  paint(ui, *ImGui::GetWindowDrawList(), metrics::pareto_chart(curves, options), corner);
  if (!task.is_current()) draw_outdated_label(ui, corner, metrics::pareto_frame(curves, options));
  return draw_points(ui, task, curves, options, corner);
}

}  // namespace

std::optional<size_t> draw_convergence_chart(UiContext& ui, const ConvergenceTask& task, const ImVec2& size) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (size.x < 80 || size.y < 60) return std::nullopt;
  ImGui::InvisibleButton("##plot", size);
  ImGui::SetItemAllowOverlap();  // the dots of the Pareto chart are buttons
  ui.items.add("compare.chart");
  const bool hovered = ImGui::IsItemHovered();
  const auto curves = task.curves();
  const bool has_points = std::ranges::any_of(curves, [](const MethodCurves& c) { return !c.repeats.empty(); });
  if (!has_points) {
    draw_placeholder(ui, task.running(), corner, size);
    return std::nullopt;
  }
  const metrics::ChartOptions options = panel_chart_options(ui, task, size);
  if (task.parameters.chart == ConvergenceChart::pareto) return draw_pareto_chart(ui, task, curves, options, corner);
  paint(ui, *ImGui::GetWindowDrawList(), metrics::convergence_chart(curves, options), corner);
  if (!task.is_current()) draw_outdated_label(ui, corner, metrics::chart_frame(curves, options));
  if (hovered) CrossHair(ui, corner, curves, options).draw();
  return std::nullopt;
}

}  // namespace etendue::viewer
