#include "viewer/widgets/plot.h"

#include <algorithm>
#include <cmath>

#include "viewer/widgets/ui_context.h"

namespace etendue::viewer {
namespace {

using Ticks = std::vector<metrics::LogAxis::Tick>;

// Ticks at multiples of 1, 2 or 5 times a power of ten.
Ticks linear_ticks(double low, double high, int max_count) {
  const double min_step = (high - low) / max_count;
  const double power = std::pow(10.0, std::floor(std::log10(min_step)));
  double step = 10 * power;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power >= min_step) step = digit * power;
  Ticks ticks;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push_back({i * step, metrics::short_number(i * step + 0.0)});  // adding 0 turns -0 into 0
  return ticks;
}

}  // namespace

double PlotAxis::position(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  return metrics::LogAxis(low, high, 0, 1).position(std::max(value, low * 1e-3));
}

Ticks PlotAxis::ticks(int max_labels) const {
  if (!logarithmic) return linear_ticks(low, high, max_labels);
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
  float left_margin = 0;
  for (const auto& tick : y_ticks_)
    left_margin = std::max(left_margin, font->CalcTextSizeA(font->FontSize, 1e6f, 0, tick.label.c_str()).x);
  left_margin += em * 0.5f;
  area_.corner = frame.corner + Vec2(left_margin, em * 1.5f);
  area_.size = glm::max(frame.size - Vec2(left_margin + em, em * 2.8f), Vec2(1));
  x_ticks_ = x_.ticks(static_cast<int>(area_.size.x / (em * 2.6f)));
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
