#include "viewer/viewport/safe_frames.h"

#include <imgui.h>

#include "viewer/state/app_state.h"

namespace etendue::viewer {
namespace {

constexpr float kActionSafe = 0.93f, kTitleSafe = 0.9f;
constexpr ImU32 kBorder = IM_COL32(0, 0, 0, 110), kLine = IM_COL32(235, 235, 235, 170);

Placement scaled_about_centre(const Placement& image, float scale) {
  return {.corner = image.corner + image.size * (0.5f * (1 - scale)), .size = image.size * scale};
}

void draw_frame(const Placement& area, ImDrawList& draw) {
  const Vec2 end = area.corner + area.size;
  draw.AddRect({area.corner.x, area.corner.y}, {end.x, end.y}, kBorder, 0, 0, 3);
  draw.AddRect({area.corner.x, area.corner.y}, {end.x, end.y}, kLine, 0, 0, 1);
}

void draw_cross(Vec2 at, float half, ImDrawList& draw) {
  for (const auto& [color, width] : {std::pair{kBorder, 3.0f}, std::pair{kLine, 1.0f}}) {
    draw.AddLine({at.x - half, at.y}, {at.x + half, at.y}, color, width);
    draw.AddLine({at.x, at.y - half}, {at.x, at.y + half}, color, width);
  }
}

}  // namespace

std::array<Placement, 2> safe_areas(const Placement& image) {
  return {scaled_about_centre(image, kActionSafe), scaled_about_centre(image, kTitleSafe)};
}

void draw_safe_frames(const AppState& state, ImDrawList& draw) {
  const Placement& image = state.viewport.image;
  for (const Placement& area : safe_areas(image)) draw_frame(area, draw);
  draw_cross(image.corner + image.size * 0.5f, 0.5f * ImGui::GetFontSize(), draw);
}

}  // namespace etendue::viewer
