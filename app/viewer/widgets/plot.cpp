#include "viewer/widgets/plot.h"

#include <cmath>

namespace etendue::viewer {
namespace {

std::vector<metrics::LogAxis::Tick> even_ticks(double low, double high, int most) {
  const double least = (high - low) / most, power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power >= least) step = digit * power;
  std::vector<metrics::LogAxis::Tick> ticks;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push_back({i * step, metrics::short_number(i * step + 0.0)});  // no -0
  return ticks;
}

}  // namespace

double PlotAxis::share(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  return metrics::LogAxis(low, high, 0, 1).place(std::max(value, low * 1e-3));
}

std::vector<metrics::LogAxis::Tick> PlotAxis::ticks(int most) const {
  if (!logarithmic) return even_ticks(low, high, most);
  auto list = metrics::LogAxis(low, high, 0, 1).ticks();
  int labels = 0;
  for (const auto& tick : list) labels += tick.label.empty() ? 0 : 1;
  // Where 2 and 5 would crowd the axis, powers of ten are enough.
  if (labels > most)
    for (auto& tick : list)
      if (const double power = std::log10(tick.value); std::abs(power - std::round(power)) > 1e-6) tick.label.clear();
  return list;
}

Plot::Plot(const Workbench& w, ImDrawList* draw, const Placement& frame, const char* title, const PlotAxis& x,
           const PlotAxis& y)
    : w_(w), draw_(draw), frame_(frame), title_(title), x_(x), y_(y) {
  const float em = ImGui::GetFontSize();
  up_ = y_.ticks(static_cast<int>((frame.size.y - em * 2.8f) / (em * 1.6f)));
  float margin = 0;
  for (const auto& tick : up_)
    margin = std::max(margin, w.faces.figures->CalcTextSizeA(w.faces.figures->FontSize, 1e6f, 0, tick.label.c_str()).x);
  margin += em * 0.5f;
  inner_ = {frame.corner + Vec2(margin, em * 1.5f), glm::max(frame.size - Vec2(margin + em, em * 2.8f), Vec2(1))};
  across_ = x_.ticks(static_cast<int>(inner_.size.x / (em * 2.6f)));
}

ImVec2 Plot::at(double x, double y) const {
  return {inner_.corner.x + inner_.size.x * static_cast<float>(x_.share(x)),
          inner_.corner.y + inner_.size.y * static_cast<float>(1 - y_.share(y))};
}

void Plot::words(ImVec2 at, float anchor, ImU32 color, const char* text) const {
  ImFont* font = w_.faces.figures;
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text);
  draw_->AddText(font, font->FontSize, {std::floor(at.x - anchor * size.x), std::floor(at.y - 0.5f * size.y)}, color,
                 text);
}

void Plot::draw_axes() const {
  const float em = ImGui::GetFontSize();
  const ImU32 line = ImGui::GetColorU32(ImGuiCol_Border, 0.6f), quiet = ImGui::GetColorU32(w_.theme.quiet);
  const ImVec2 low{inner_.corner.x, inner_.corner.y + inner_.size.y},
      high{inner_.corner.x + inner_.size.x, inner_.corner.y};
  draw_->AddText({inner_.corner.x, frame_.corner.y}, ImGui::GetColorU32(ImGuiCol_Text), title_);
  for (const auto& tick : across_) {
    const float x = low.x + inner_.size.x * static_cast<float>(x_.share(tick.value));
    if (tick.label.empty()) continue;
    draw_->AddLine({x, low.y}, {x, high.y}, line);
    words({x, low.y + em * 0.75f}, 0.5f, quiet, tick.label.c_str());
  }
  for (const auto& tick : up_) {
    const float y = low.y - inner_.size.y * static_cast<float>(y_.share(tick.value));
    if (tick.label.empty()) continue;
    draw_->AddLine({low.x, y}, {high.x, y}, line);
    words({low.x - em * 0.3f, y}, 1, quiet, tick.label.c_str());
  }
  draw_->AddRect({low.x, high.y}, {high.x, low.y}, ImGui::GetColorU32(ImGuiCol_Border));
}

void Plot::curve(const std::vector<ImVec2>& points, ImU32 color, float width) const {
  draw_->AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, width);
}

ImU32 half_color(const Workbench& w, int half) {
  if (w.theme.dark) return half == 0 ? IM_COL32(0x56, 0xb4, 0xe9, 255) : IM_COL32(0xe6, 0x9f, 0x00, 255);
  return half == 0 ? IM_COL32(0x00, 0x72, 0xb2, 255) : IM_COL32(0xd5, 0x5e, 0x00, 255);
}

}  // namespace etendue::viewer
