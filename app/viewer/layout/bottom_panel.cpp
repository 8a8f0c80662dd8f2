#include "viewer/layout/bottom_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/layout/detached_panels.h"
#include "viewer/layout/layout_parts.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"

namespace etendue::viewer {
namespace {

constexpr float kDefaultShare = 0.36f;  // of the height of the region
constexpr float kMaxShare = 0.75f;
constexpr float kMinHeight = 120;  // units of the interface

float tab_height() { return std::floor(ImGui::GetFontSize() + 10); }

void begin_window(const char* name, const ImVec2& corner, const ImVec2& size, const ImVec2& padding) {
  ImGui::SetNextWindowPos(corner);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(name, nullptr, kFixedWindow);
}

void end_window() {
  ImGui::End();
  ImGui::PopStyleVar(2);
}

void draw_tab(AppState& state, Panel& panel) {
  const PanelInfo info = panel.info();
  const bool open = state.panels.is_open(panel);
  const Theme& theme = state.ui.theme;
  ImGui::PushStyleColor(ImGuiCol_Text, open ? theme.accent : theme.secondary_text);
  const bool clicked = ImGui::Selectable(info.label, open, 0, {ImGui::CalcTextSize(info.label).x, 0});
  ImGui::PopStyleColor();
  state.ui.items.add(info.name);
  if (ImGui::IsItemHovered() && !open) tooltip(state.ui, info.description);
  tab_menu(state, panel);
  if (clicked) state.panels.toggle(panel);
}

const ImVec2 kTabPadding{10, 5};  // pixels

// The space between tabs: less where they would not fit.
float tab_distance(const AppState& state, float right) {
  const float font_size = ImGui::GetFontSize();
  float texts = 0;
  int gaps = -1;
  for (const auto& panel : state.panels.all()) {
    if (panel->info().place != PanelPlace::bottom) continue;
    texts += ImGui::CalcTextSize(panel->info().label).x;
    ++gaps;
  }
  const float space = (right - 2 * kTabPadding.x - texts) / static_cast<float>(std::max(gaps, 1));
  return std::clamp(space, 0.4f * font_size, 1.4f * font_size);
}

// The upper side resizes an open panel.
void draw_resize_grip(AppState& state, float top, float right, float bottom) {
  const ImVec2 start = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({0, top});
  ImGui::InvisibleButton("##grip", {right, kTabPadding.y});
  state.ui.items.add("layout.bottom-panel");
  const bool active = ImGui::IsItemActive();
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (active || hovered) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
    draw->AddLine({0, top + 1}, {right, top + 1}, ImGui::GetColorU32(state.ui.theme.accent), 2);
    if (hovered) tooltip(state.ui, "Drag to change the height; double-click to reset it");
  } else {
    draw_grip_dots(draw, {right / 2, top + 2.5f * state.ui.scale}, {6 * state.ui.scale, 0}, state.ui.theme);
  }
  if (active) state.settings.bottom_panel_height = (bottom - state.ui.input.mouse.y) / state.ui.scale;
  if (hovered && ImGui::IsMouseDoubleClicked(0)) state.settings.bottom_panel_height = 0;
  ImGui::SetCursorScreenPos(start);
}

void draw_tabs(AppState& state, float top, float right, float bottom, bool resizable) {
  begin_window("##bottom-tabs", {0, top}, {right, tab_height()}, kTabPadding);
  if (resizable) draw_resize_grip(state, top, right, bottom);
  const float distance = tab_distance(state, right);
  bool first = true;
  for (const auto& panel : state.panels.all()) {
    if (panel->info().place != PanelPlace::bottom) continue;
    if (!first) ImGui::SameLine(0, distance);
    first = false;
    draw_tab(state, *panel);
  }
  end_window();
}

float panel_height(const AppState& state, float available) {
  const float scale = state.ui.scale;
  const float set_height = state.settings.bottom_panel_height * scale;
  const float height = set_height > 0 ? set_height : available * kDefaultShare;
  return std::floor(std::clamp(height, std::min(kMinHeight * scale, available * 0.5f), available * kMaxShare));
}

}  // namespace

float draw_bottom_panel(AppState& state, float top, float right, float bottom) {
  Panel* panel = state.panels.open_bottom_panel();
  if (!panel) {
    draw_tabs(state, bottom - tab_height(), right, bottom, false);
    return bottom - tab_height();
  }
  const float panel_top = bottom - panel_height(state, bottom - top);
  draw_tabs(state, panel_top, right, bottom, true);
  begin_window("##bottom-panel", {0, panel_top + tab_height()}, {right, bottom - panel_top - tab_height()}, {10, 6});
  ImGui::BeginChild(panel->info().name);
  if (state.has_document())
    panel->draw(state);
  else
    note(state.ui, "No scene is open.");
  ImGui::EndChild();
  end_window();
  return panel_top;
}

}  // namespace etendue::viewer
