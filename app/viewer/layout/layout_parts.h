// What the windows that form the layout share.
#pragma once
#include <imgui.h>

#include "viewer/platform/theme.h"

namespace etendue::viewer {

inline constexpr ImGuiWindowFlags kFixedWindow =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollbar;

// Three dots, which mark a splitter; `step` leads from one to the next.
inline void draw_grip_dots(ImDrawList* draw, const ImVec2& center, const ImVec2& step, const Theme& theme) {
  const ImU32 color = ImGui::GetColorU32(theme.secondary_text);
  const float radius = (step.x + step.y) * 0.25f;
  for (const float i : {-1.0f, 0.0f, 1.0f})
    draw->AddCircleFilled({center.x + i * step.x, center.y + i * step.y}, radius, color);
}

}  // namespace etendue::viewer
