#include "viewer/panels/convergence_chart.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/widgets/chart_painter.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

using metrics::MethodCurves;

metrics::Ink faded(metrics::Ink ink, double opacity) { return ink.opacity *= opacity, ink; }

metrics::ChartOptions panel_options(const Workbench& w, const ImVec2& size) {
  metrics::ChartOptions options = w.contest.chart_options();
  const float scale = w.platform.scale();
  options.width = static_cast<int>(size.x / scale), options.height = static_cast<int>(size.y / scale);
  options.panel = true;
  const metrics::Ink border = ink_of(ImGui::GetStyleColorVec4(ImGuiCol_Border));
  options.palette = {ink_of(w.theme.text), ink_of(w.theme.quiet), border, faded(border, 0.45)};
  const auto* contest = w.contest.shown();
  const bool timed = contest && contest->rule == bench::Rule::equal_time;
  if (contest && timed == (options.along == metrics::Abscissa::seconds))
    options.reach = timed ? contest->seconds : contest->samples;
  return options;
}

// What one method has at the abscissa of the cross-hair.
struct Reading {
  size_t method;
  metrics::BandPoint point;
};

std::vector<Reading> readings(const std::vector<MethodCurves>& curves, const metrics::ChartOptions& options, double x) {
  std::vector<Reading> list;
  for (size_t i = 0; i < curves.size(); ++i) {
    const auto points = metrics::band_of(curves[i], options.along, options.kind, std::array{x});
    if (!points.empty()) list.push_back({i, points.front()});
  }
  return list;
}

// "path, sobol  0.0123  0.0118 to 0.0131  x1.32": the last as a multiple of the smallest.
std::string line_of(const MethodCurves& curves, const Reading& reading, double least, size_t name_width) {
  const auto& p = reading.point;
  std::string text = curves.name;
  text.resize(name_width, ' ');
  text += text_of("  %-7.3g", p.median);
  if (curves.repeats.size() > 1) text += text_of(" %6.3g to %-6.3g", p.low, p.high);
  return text + text_of(" \u00d7%.2f", p.median / least);
}

// The read-out beside the pointer: what stands there, and where.
class ReadOut {
 public:
  ReadOut(const Workbench& w, const ImVec2& corner, const std::vector<MethodCurves>& curves,
          const metrics::ChartOptions& options)
      : w_(w),
        corner_(corner),
        curves_(curves),
        options_(options),
        frame_(metrics::frame_of_chart(curves, options)),
        scale_(w.platform.scale()) {}

  void draw() {
    const double x = (w_.input.mouse.x - corner_.x) / scale_, y = (w_.input.mouse.y - corner_.y) / scale_;
    if (x < frame_.left || x > frame_.right || y < frame_.top || y > frame_.bottom) return;
    readings_ = readings(curves_, options_, frame_.x.value(x));
    cross_hair(x, y);
    const bool seconds = options_.along == metrics::Abscissa::seconds;
    std::string head = metrics::short_number(frame_.x.value(x)) + (seconds ? " s" : " spp");
    if (readings_.empty()) head += ", " + metrics::short_number(frame_.y.value(y));
    box(x, head, lines());
  }

 private:
  ImVec2 at(double x, double y) const {
    return {corner_.x + static_cast<float>(x) * scale_, corner_.y + static_cast<float>(y) * scale_};
  }

  // Where there is nothing to read, the place itself is read.
  void cross_hair(double x, double y) const {
    const ImU32 quiet = ImGui::GetColorU32(w_.theme.quiet);
    draw_->AddLine(at(x, frame_.top), at(x, frame_.bottom), quiet);
    if (readings_.empty()) draw_->AddLine(at(frame_.left, y), at(frame_.right, y), quiet);
    for (const auto& r : readings_)
      draw_->AddCircleFilled(at(x, frame_.y.place(r.point.median)), 3.5f * scale_,
                             color_of(metrics::ink_of_method(r.method)));
  }

  std::vector<std::string> lines() const {
    size_t name_width = 0;
    double least = INFINITY;
    for (const auto& r : readings_)
      name_width = std::max(name_width, curves_[r.method].name.size()), least = std::min(least, r.point.median);
    std::vector<std::string> list;
    for (const auto& r : readings_) list.push_back(line_of(curves_[r.method], r, least, name_width));
    return list;
  }

  // How much of the curves a box would cover.
  int covered(const ImVec2& corner, const ImVec2& size) const {
    constexpr int kPlaces = 16;
    int count = 0;
    for (int i = 0; i <= kPlaces; ++i) {
      const double x = (corner.x + size.x * static_cast<float>(i) / kPlaces - corner_.x) / scale_;
      for (const auto& r : readings(curves_, options_, frame_.x.value(x))) {
        const float y = at(0, frame_.y.place(r.point.median)).y;
        if (y > corner.y && y < corner.y + size.y) ++count;
      }
    }
    return count;
  }

  // Beside the line where there is more room; above or below, where less is covered.
  ImVec2 place_of(double x, const ImVec2& size, float gap) const {
    const ImVec2 low = at(frame_.left, frame_.top), high = at(frame_.right, frame_.bottom), line = at(x, 0);
    const bool right = x < 0.5 * (frame_.left + frame_.right);
    const float left =
        std::clamp(right ? line.x + gap : line.x - size.x - gap, low.x, std::max(low.x, high.x - size.x));
    const ImVec2 above{left, low.y + gap}, below{left, high.y - size.y - gap};
    return covered(below, size) < covered(above, size) ? below : above;
  }

  void box(double x, const std::string& head, const std::vector<std::string>& text) const {
    ImFont* font = w_.faces.small;
    const float size = font->FontSize, gap = size * 0.6f, row = size + 3 * scale_, swatch = size * 1.2f;
    const auto width_of = [&](const std::string& s) { return font->CalcTextSizeA(size, 1e6f, 0, s.c_str()).x; };
    float width = width_of(head);
    for (const auto& line : text) width = std::max(width, width_of(line) + swatch);
    const ImVec2 extent{width + 2 * gap, row * static_cast<float>(text.size() + 1) + gap};
    const ImVec2 place = place_of(x, extent, gap);
    draw_->AddRectFilled(place, {place.x + extent.x, place.y + extent.y}, ImGui::GetColorU32(ImGuiCol_PopupBg), 4);
    draw_->AddRect(place, {place.x + extent.x, place.y + extent.y}, ImGui::GetColorU32(ImGuiCol_Border), 4);
    ImVec2 next{place.x + gap, place.y + gap * 0.5f};
    draw_->AddText(font, size, next, ImGui::GetColorU32(w_.theme.quiet), head.c_str());
    for (size_t i = 0; i < text.size(); ++i) {
      next.y += row;
      draw_->AddRectFilled({next.x, next.y + size * 0.2f}, {next.x + size * 0.7f, next.y + size * 0.9f},
                           color_of(metrics::ink_of_method(readings_[i].method)), 2);
      draw_->AddText(font, size, {next.x + swatch, next.y}, ImGui::GetColorU32(w_.theme.text), text[i].c_str());
    }
  }

  const Workbench& w_;
  const ImVec2 corner_;
  const std::vector<MethodCurves>& curves_;
  const metrics::ChartOptions& options_;
  const metrics::ChartFrame frame_;
  const float scale_;
  std::vector<Reading> readings_;
  ImDrawList* const draw_ = ImGui::GetWindowDrawList();
};

void invitation(const Workbench& w, const ImVec2& corner, const ImVec2& size) {
  const std::string text =
      w.contest.running()
          ? "The first turns are being taken."
          : "Press Compare: the methods take turns on this scene,\nand their errors grow here as curves.";
  const ImVec2 words = ImGui::CalcTextSize(text.c_str());
  ImGui::GetWindowDrawList()->AddText({corner.x + (size.x - words.x) * 0.5f, corner.y + (size.y - words.y) * 0.5f},
                                      ImGui::GetColorU32(w.theme.quiet), text.c_str());
}

// Curves descend: the lower left corner is free.
void mark_as_past(const Workbench& w, const ImVec2& corner, const metrics::ChartFrame& frame) {
  const float scale = w.platform.scale(), size = w.faces.small->FontSize;
  const ImVec2 at{corner.x + static_cast<float>(frame.left + 8) * scale,
                  corner.y + static_cast<float>(frame.bottom - 6) * scale - size};
  ImGui::GetWindowDrawList()->AddText(w.faces.small, size, at, ImGui::GetColorU32(w.theme.warning),
                                      "of the scene before the edit");
}

}  // namespace

void draw_convergence_chart(Workbench& w) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  if (size.x < 80 || size.y < 60) return;
  ImGui::InvisibleButton("##plot", size);
  w.items.place("compare.chart");
  const bool over = ImGui::IsItemHovered();
  const auto curves = w.contest.curves();
  const bool any = std::ranges::any_of(curves, [](const MethodCurves& c) { return !c.repeats.empty(); });
  if (!any) return invitation(w, corner, size);
  const metrics::ChartOptions options = panel_options(w, size);
  draw(*ImGui::GetWindowDrawList(), metrics::chart_of(curves, options), corner, w.platform.scale(), w.faces.small);
  if (!w.contest.up_to_date()) mark_as_past(w, corner, metrics::frame_of_chart(curves, options));
  if (over) ReadOut(w, corner, curves, options).draw();
}

}  // namespace etendue::viewer
