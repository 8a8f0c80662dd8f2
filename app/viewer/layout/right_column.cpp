#include "viewer/layout/right_column.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/files/loader.h"
#include "viewer/layout/detached_panels.h"
#include "viewer/layout/layout_parts.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/filter_box.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

// In units of the interface.
constexpr float kMinWidth = 240;
constexpr float kMinDefaultWidth = 370;
constexpr float kMaxDefaultWidth = 460;

float column_width(const AppState& state, float screen_width) {
  const float scale = state.ui.scale;
  const float default_width = std::clamp(screen_width * 0.3f, kMinDefaultWidth * scale, kMaxDefaultWidth * scale);
  const float width = state.settings.column_width > 0 ? state.settings.column_width * scale : default_width;
  return std::floor(std::clamp(width, std::min(kMinWidth * scale, screen_width * 0.5f), screen_width * 0.7f));
}

// Narrow tabs, so that all labels fit.
void push_tab_style(float scale) {
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {5 * scale, 5 * scale});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {2, 4});
}
void pop_tab_style() { ImGui::PopStyleVar(2); }

void draw_tab(AppState& state, Panel& panel, bool select) {
  const PanelInfo info = panel.info();
  const bool open = ImGui::BeginTabItem(info.label, nullptr, select ? ImGuiTabItemFlags_SetSelected : 0);
  state.ui.items.add(info.name);
  // The tooltip would cover the filter of the panel that a click has opened.
  if (ImGui::IsItemHovered() && !open) tooltip(state.ui, info.description);
  tab_menu(state, panel);
  if (!open) return;
  state.panels.set_selected_tab(panel);
  pop_tab_style();
  draw_column_panel(state, panel, "layout.filter", state.interface.panel_filter);
  push_tab_style(state.ui.scale);
  ImGui::EndTabItem();
}

void draw_tabs(AppState& state) {
  push_tab_style(state.ui.scale);
  if (ImGui::BeginTabBar("##tabs", ImGuiTabBarFlags_FittingPolicyResizeDown | ImGuiTabBarFlags_NoTooltip)) {
    const Panel* requested = state.panels.take_requested_tab();
    for (const auto& panel : state.panels.all())
      if (panel->info().place == PanelPlace::right_column && !state.panels.is_detached(*panel))
        draw_tab(state, *panel, panel.get() == requested);
    ImGui::EndTabBar();
  }
  pop_tab_style();
}

void draw_splitter(AppState& state, float x, float top, float height) {
  const float grip = std::max(6.0f, ImGui::GetFontSize() * 0.4f);
  ImGui::SetNextWindowPos({x - grip, top});  // beside the column, which may be in front
  ImGui::SetNextWindowSize({grip, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("##splitter", nullptr, kFixedWindow | ImGuiWindowFlags_NoBackground);
  ImGui::PopStyleVar(2);  // which are not those of the tooltip
  ImGui::InvisibleButton("##grip", {grip, height});
  state.ui.items.add("layout.column");
  const bool pointed_at = ImGui::IsItemHovered() || ImGui::IsItemActive();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (pointed_at) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    draw->AddRectFilled({x - 2, top}, {x, top + height}, ImGui::GetColorU32(state.ui.theme.accent));
    tooltip(state.ui, "Drag to change the width; double-click to reset it");
  } else {
    draw_grip_dots(draw, {x - grip / 2, top + height / 2}, {0, 6 * state.ui.scale}, state.ui.theme);
  }
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0))  // not by the clicks that reset it
    state.settings.column_width = (ImGui::GetIO().DisplaySize.x - state.ui.input.mouse.x) / state.ui.scale;
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) state.settings.column_width = 0;
  ImGui::End();
}

}  // namespace

void draw_column_panel(AppState& state, Panel& panel, const std::string& item, std::string& filter) {
  filter_box(state.ui, item, "Filter parameters and objects", filter);
  ImGui::BeginChild("##panel");
  state.ui.filter = lower_case(filter);
  if (state.has_document())
    panel.draw(state);
  else if (state.files.loader->is_busy())
    note(state.ui, "Opening the scene.");
  else
    note(state.ui, "Open a scene with File > Open..., or drop a file on the window.");
  state.ui.filter.clear();
  ImGui::EndChild();
}

float draw_right_column(AppState& state, float top, float bottom) {
  const float screen_width = ImGui::GetIO().DisplaySize.x;
  const float width = column_width(state, screen_width);
  const float left = screen_width - width;
  ImGui::SetNextWindowPos({left, top});
  ImGui::SetNextWindowSize({width, bottom - top});
  ImGui::Begin("##column", nullptr, kFixedWindow);
  draw_tabs(state);
  ImGui::End();
  draw_splitter(state, left, top, bottom - top);
  return left;
}

}  // namespace etendue::viewer
