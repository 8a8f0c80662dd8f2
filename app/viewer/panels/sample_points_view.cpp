#include "viewer/panels/sample_points_view.h"

#include <imgui.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "film/half_buffers.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/plot.h"

namespace etendue::viewer {

std::array<int, 2> interval_grid(IntervalShape shape, uint32_t points) {
  const uint32_t count = std::bit_floor(std::max<uint32_t>(1, points / film::kHalfBuffers));
  const auto side = static_cast<int>(1U << (std::bit_width(count) - 1) / 2);
  switch (shape) {
    case IntervalShape::square:
      return {side, side};
    case IntervalShape::columns:
      return {static_cast<int>(count), 1};
    case IntervalShape::rows:
      return {1, static_cast<int>(count)};
    case IntervalShape::none:
      break;
  }
  return {1, 1};
}

void draw_sample_points(const UiContext& ui, ImDrawList* draw, const Placement& frame, const std::string& title,
                        std::span<const Vec2> points, IntervalShape intervals) {
  const float em = ImGui::GetFontSize();
  const float side = std::floor(frame.size.y - em * 1.7f);
  const Vec2 corner = frame.corner + Vec2(0, em * 1.5f);
  draw->PushClipRect({frame.corner.x, frame.corner.y}, {frame.corner.x + frame.size.x, corner.y + side + em}, true);
  draw->AddText({frame.corner.x, frame.corner.y}, ImGui::GetColorU32(ImGuiCol_Text), title.c_str());
  draw->PopClipRect();
  draw->AddRectFilled({corner.x, corner.y}, {corner.x + side, corner.y + side},
                      ImGui::GetColorU32(ImGuiCol_FrameBg, 0.4f));
  const auto count = static_cast<uint32_t>(points.size());
  const auto [columns, rows] = interval_grid(intervals, count);
  // Lines that are closer than three pixels would fill the square.
  const ImU32 grid = ImGui::GetColorU32(ImGuiCol_Border, 0.8f);
  const auto draw_lines = [&](int cells, const Vec2& along, const Vec2& across) {
    if (side < 3.0f * static_cast<float>(cells)) cells = 1;
    for (int i = 0; i <= cells; ++i) {
      const Vec2 from = corner + along * (side * static_cast<float>(i) / static_cast<float>(cells));
      const Vec2 to = from + across * side;
      draw->AddLine({from.x, from.y}, {to.x, to.y}, grid);
    }
  };
  draw_lines(columns, {1, 0}, {0, 1});
  draw_lines(rows, {0, 1}, {1, 0});
  const float radius = em * (count > 1000 ? 0.07f : count > 200 ? 0.1f : 0.17f);
  for (size_t i = 0; i < points.size(); ++i)
    draw->AddCircleFilled({corner.x + side * points[i].x, corner.y + side * (1 - points[i].y)}, radius,
                          half_buffer_color(ui, static_cast<int>(i % film::kHalfBuffers)), 8);
}

}  // namespace etendue::viewer
