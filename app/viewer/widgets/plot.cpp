#include "viewer/widgets/plot.h"

#include <algorithm>
#include <cmath>

#include "viewer/widgets/ui_context.h"

namespace etendue::viewer {
namespace {

using Ticks = std::vector<metrics::LogAxis::Tick>;

float text_width(const ImFont* font, const std::string& text) {
  return font->CalcTextSizeA(font->FontSize, 1e6f, 0, text.c_str()).x;
}

float widest_label(const ImFont* font, const Ticks& ticks) {
  float widest = 0;
  for (const auto& tick : ticks) widest = std::max(widest, text_width(font, tick.label));
  return widest;
}

// The most ticks whose labels fit beside each other in this width.
Ticks ticks_beside(const PlotAxis& axis, float width, const ImFont* font, float em) {
  for (int count = static_cast<int>(width / (2.6f * em));; --count) {
    Ticks ticks = axis.ticks(count);
    const auto labels = std::ranges::count_if(ticks, [](const auto& tick) { return !tick.label.empty(); });
    if (count <= 1 || static_cast<float>(labels) * (widest_label(font, ticks) + 0.6f * em) <= width) return ticks;
  }
}

}  // namespace

double PlotAxis::position(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  return metrics::LogAxis(low, high, 0, 1).position(std::max(value, low * 1e-3));
}

Ticks PlotAxis::ticks(int max_labels) const {
  if (!logarithmic) return metrics::linear_ticks(low, high, std::max(max_labels, 1));
  auto ticks = metrics::LogAxis(low, high, 0, 1).ticks();
  const auto labels = std::ranges::count_if(ticks, [](const auto& tick) { return !tick.label.empty(); });
  if (labels <= max_labels) return ticks;
  // With little space, only powers of ten have labels.
  for (auto& tick : ticks) {
    const double exponent = std::log10(tick.value);
    if (std::abs(exponent - std::round(exponent)) > 1e-6) tick.label.clear();
  }
  return ticks;
}

Plot::Plot(const UiContext& ui, ImDrawList* draw, const Placement& frame, const char* title, const PlotAxis& x,
           const PlotAxis& y)
    : ui_(ui), draw_(draw), frame_(frame), title_(title), x_(x), y_(y) {
  const float em = ImGui::GetFontSize();
  const ImFont* font = ui.fonts.monospace;
  y_ticks_ = y_.ticks(static_cast<int>((frame.size.y - em * 2.8f) / (em * 1.6f)));
  const float left_margin = widest_label(font, y_ticks_) + em * 0.5f;
  area_.corner = frame.corner + Vec2(left_margin, em * 1.5f);
  area_.size = glm::max(frame.size - Vec2(left_margin + em, em * 2.8f), Vec2(1));
  x_ticks_ = ticks_beside(x_, area_.size.x, font, em);
}

ImVec2 Plot::at(double x, double y) const {
  return {area_.corner.x + area_.size.x * static_cast<float>(x_.position(x)),
          area_.corner.y + area_.size.y * static_cast<float>(1 - y_.position(y))};
}

void Plot::draw_text(ImVec2 position, float anchor, ImU32 color, const char* text) const {
  ImFont* font = ui_.fonts.monospace;
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text);
  const ImVec2 corner{std::floor(position.x - anchor * size.x), std::floor(position.y - 0.5f * size.y)};
  draw_->AddText(font, font->FontSize, corner, color, text);
}

void Plot::draw_axes() const {
  const float em = ImGui::GetFontSize();
  const ImU32 grid = ImGui::GetColorU32(ImGuiCol_Border, 0.6f);
  const ImU32 label = ImGui::GetColorU32(ui_.theme.secondary_text);
  const float left = area_.corner.x;
  const float top = area_.corner.y;
  const float right = left + area_.size.x;
  const float bottom = top + area_.size.y;
  draw_->AddText({left, frame_.corner.y}, ImGui::GetColorU32(ImGuiCol_Text), title_);
  for (const auto& tick : x_ticks_) {
    if (tick.label.empty()) continue;
    const float x = left + area_.size.x * static_cast<float>(x_.position(tick.value));
    draw_->AddLine({x, bottom}, {x, top}, grid);
    draw_text({x, bottom + em * 0.75f}, 0.5f, label, tick.label.c_str());
  }
  for (const auto& tick : y_ticks_) {
    if (tick.label.empty()) continue;
    const float y = bottom - area_.size.y * static_cast<float>(y_.position(tick.value));
    draw_->AddLine({left, y}, {right, y}, grid);
    draw_text({left - em * 0.3f, y}, 1, label, tick.label.c_str());
  }
  draw_->AddRect({left, top}, {right, bottom}, ImGui::GetColorU32(ImGuiCol_Border));
}

void Plot::draw_curve(const std::vector<ImVec2>& points, ImU32 color, float width) const {
  draw_->AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, width);
}

ImU32 half_buffer_color(const UiContext& ui, int half) {
  if (ui.theme.dark) return half == 0 ? IM_COL32(0x56, 0xb4, 0xe9, 255) : IM_COL32(0xe6, 0x9f, 0x00, 255);
  return half == 0 ? IM_COL32(0x00, 0x72, 0xb2, 255) : IM_COL32(0xd5, 0x5e, 0x00, 255);
}

}  // namespace etendue::viewer
