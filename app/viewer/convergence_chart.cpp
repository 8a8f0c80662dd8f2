#include "viewer/convergence_chart.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/drawing_imgui.h"
#include "viewer/widgets.h"
#include "viewer/words.h"

namespace etendue::viewer {
namespace {

using measure::MethodCurves;

measure::Ink faded(measure::Ink ink, double opacity) { return ink.opacity *= opacity, ink; }

measure::ChartOptions panel_options(const Workbench& w, const ImVec2& size) {
  measure::ChartOptions options = w.contest.chart_options();
  const float scale = w.platform.scale();
  options.width = static_cast<int>(size.x / scale), options.height = static_cast<int>(size.y / scale);
  options.panel = true;
  const measure::Ink border = ink_of(ImGui::GetStyleColorVec4(ImGuiCol_Border));
  options.palette = {ink_of(w.theme.text), ink_of(w.theme.quiet), border, faded(border, 0.45)};
  const auto* contest = w.contest.shown();
  const bool timed = contest && contest->rule == bench::Rule::equal_time;
  if (contest && timed == (options.along == measure::Abscissa::seconds)) options.reach = timed ? contest->seconds : contest->samples;
  return options;
}

// What one method has at the abscissa of the cross-hair.
struct Reading {
  size_t method;
  measure::BandPoint point;
};

std::vector<Reading> readings(const std::vector<MethodCurves>& curves, const measure::ChartOptions& options, double x) {
  std::vector<Reading> list;
  for (size_t i = 0; i < curves.size(); ++i) {
    const auto points = measure::band_of(curves[i], options.along, options.kind, std::array{x});
    if (!points.empty()) list.push_back({i, points.front()});
  }
  return list;
}

// "path, sobol  0.0123 (0.0118 to 0.0131)  x 1.32": the last as a multiple of the smallest.
std::string line_of(const Workbench& w, const MethodCurves& curves, const Reading& reading, double least, size_t name_width) {
  const auto& p = reading.point;
  std::string name = curves.name;
  name.resize(name_width, ' ');
  std::string text = name + text_of("  %-8.3g", p.median);
  if (curves.repeats.size() > 1) text += text_of(" %.3g to %.3g ", p.low, p.high);
  if (w.contest.shown()->methods.size() > 1) text += text_of(" \u00d7%.2f", p.median / least);
  return text;
}

void read_out(const Workbench& w, const ImVec2& corner, const std::vector<MethodCurves>& curves, const measure::ChartOptions& options, const measure::ChartFrame& frame) {
  const float scale = w.platform.scale();
  const double x = (w.input.mouse.x - corner.x) / scale, y = (w.input.mouse.y - corner.y) / scale;
  if (x < frame.left || x > frame.right || y < frame.top || y > frame.bottom) return;
  const double value = frame.x.value(x);
  const auto list = readings(curves, options, value);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto at = [&](double px, double py) { return ImVec2{corner.x + static_cast<float>(px) * scale, corner.y + static_cast<float>(py) * scale}; };
  draw->AddLine(at(x, frame.top), at(x, frame.bottom), ImGui::GetColorU32(w.theme.quiet));
  if (list.empty()) draw->AddLine(at(frame.left, y), at(frame.right, y), ImGui::GetColorU32(w.theme.quiet));

  std::vector<std::string> lines;
  const bool seconds = options.along == measure::Abscissa::seconds;
  std::string head = measure::short_number(value) + (seconds ? " s" : " spp");
  if (list.empty()) head += ", " + measure::short_number(frame.y.value(y));
  size_t name_width = 0;
  double least = INFINITY;
  for (const auto& r : list) name_width = std::max(name_width, curves[r.method].name.size()), least = std::min(least, r.point.median);
  for (const auto& r : list) lines.push_back(line_of(w, curves[r.method], r, least, name_width));
  ImFont* font = w.faces.small;
  const float size = font->FontSize, em = size * 0.6f;
  float width = font->CalcTextSizeA(size, 1e6f, 0, head.c_str()).x;
  for (const auto& line : lines) width = std::max(width, font->CalcTextSizeA(size, 1e6f, 0, line.c_str()).x + size * 1.2f);
  const ImVec2 box{width + 2 * em, (size + 3) * static_cast<float>(lines.size() + 1) + em};
  // On the side where there is more room.
  const ImVec2 pointer = at(x, y);
  ImVec2 place{x < 0.5 * (frame.left + frame.right) ? pointer.x + em * 1.5f : pointer.x - box.x - em * 1.5f, at(0, frame.top).y + em};
  place.x = std::clamp(place.x, at(frame.left, 0).x, std::max(at(frame.left, 0).x, at(frame.right, 0).x - box.x));
  draw->AddRectFilled(place, {place.x + box.x, place.y + box.y}, ImGui::GetColorU32(ImGuiCol_PopupBg, 0.93f), 4);
  draw->AddRect(place, {place.x + box.x, place.y + box.y}, ImGui::GetColorU32(ImGuiCol_Border), 4);
  draw->AddText(font, size, {place.x + em, place.y + em * 0.5f}, ImGui::GetColorU32(w.theme.quiet), head.c_str());
  for (size_t i = 0; i < lines.size(); ++i) {
    const ImU32 ink = color_of(measure::ink_of_method(list[i].method));
    const float top = place.y + em * 0.5f + (size + 3) * static_cast<float>(i + 1);
    draw->AddRectFilled({place.x + em, top + size * 0.2f}, {place.x + em + size * 0.7f, top + size * 0.9f}, ink, 2);
    draw->AddText(font, size, {place.x + em + size * 1.2f, top}, ImGui::GetColorU32(w.theme.text), lines[i].c_str());
    draw->AddCircleFilled(at(x, frame.y.place(list[i].point.median)), 3.5f * scale, ink);
  }
}

void invitation(const Workbench& w, const ImVec2& corner, const ImVec2& size) {
  const std::string text = w.contest.running() ? "The first turns are being taken." : "Press Compare: the methods take turns on this scene,\nand their errors grow here as curves.";
  const ImVec2 words = ImGui::CalcTextSize(text.c_str());
  ImGui::GetWindowDrawList()->AddText({corner.x + (size.x - words.x) * 0.5f, corner.y + (size.y - words.y) * 0.5f}, ImGui::GetColorU32(w.theme.quiet), text.c_str());
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
  const measure::ChartOptions options = panel_options(w, size);
  draw(*ImGui::GetWindowDrawList(), measure::chart_of(curves, options), corner, w.platform.scale(), w.faces.small);
  if (over) read_out(w, corner, curves, options, measure::frame_of_chart(curves, options));
}

}  // namespace etendue::viewer
