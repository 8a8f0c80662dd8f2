#include "viewer/layout/bottom_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "viewer/layout/detached_panels.h"
#include "viewer/layout/layout_parts.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"

namespace etendue::viewer {
namespace {

constexpr float kDefaultShare = 0.36f;  // of the height of the region
constexpr float kMaxShare = 0.75f;
constexpr float kMinHeight = 120;  // units of the interface

ImVec2 tab_padding(const AppState& state) { return {std::floor(10 * state.ui.scale), std::floor(5 * state.ui.scale)}; }

float tab_height(const AppState& state) { return std::floor(ImGui::GetFontSize() + 2 * tab_padding(state).y); }

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
  ImGui::PushStyleColor(ImGuiCol_Text, open ? theme.text : theme.secondary_text);
  const bool clicked = ImGui::Selectable(info.label, open, 0, {ImGui::CalcTextSize(info.label).x, 0});
  ImGui::PopStyleColor();
  state.ui.items.add(info.name);
  if (ImGui::IsItemHovered() && !open) tooltip(state.ui, info.description);
  tab_menu(state, panel);
  if (clicked) state.panels.toggle(panel);
}

std::vector<Panel*> bottom_panels(const AppState& state) {
  std::vector<Panel*> panels;
  for (const auto& panel : state.panels.all())
    if (panel->info().place == PanelPlace::bottom) panels.push_back(panel.get());
  return panels;
}

float tab_width(const Panel& panel) { return ImGui::CalcTextSize(panel.info().label).x; }

// The space between tabs: less where they would not fit into the room.
float tab_distance(std::span<Panel* const> tabs, float room) {
  float texts = 0;
  for (const Panel* tab : tabs) texts += tab_width(*tab);
  const float font_size = ImGui::GetFontSize();
  const auto gaps = static_cast<float>(std::max<size_t>(tabs.size(), 2) - 1);
  return std::clamp(std::floor((room - texts) / gaps), 0.4f * font_size, 1.4f * font_size);
}

// Which tabs fit into the room: the tab of the open panel and the chosen one, then the others from the first one on.
std::vector<bool> fitting_tabs(const AppState& state, std::span<Panel* const> tabs, const Panel* chosen, float distance,
                               float room) {
  std::vector<bool> fit(tabs.size());
  float used = -distance;
  const auto add = [&](size_t i) {
    fit[i] = true;
    used += tab_width(*tabs[i]) + distance;
  };
  for (size_t i = 0; i < tabs.size(); ++i)
    if (tabs[i] == state.panels.open_bottom_panel() || tabs[i] == chosen) add(i);
  for (size_t i = 0; i < tabs.size(); ++i) {
    if (fit[i]) continue;
    if (used + distance + tab_width(*tabs[i]) > room) break;
    add(i);
  }
  return fit;
}

// The tab that was last chosen in the list of hidden tabs or by a script. It stays in the line.
class ChosenTab {
 public:
  Panel* get() const { return static_cast<Panel*>(storage_.GetVoidPtr(id_)); }
  void set(Panel& panel) { storage_.SetVoidPtr(id_, &panel); }

 private:
  ImGuiStorage& storage_ = *ImGui::GetStateStorage();
  ImGuiID id_ = ImGui::GetID("##chosen");
};

constexpr const char* kMoreTabs = ">>";  // the button that lists the hidden tabs

// Which tabs are in the line, whose room the button shares if not all fit.
std::vector<bool> shown_tabs(const AppState& state, std::span<Panel* const> tabs, const Panel* chosen, float distance,
                             float room) {
  const std::vector<bool> fit = fitting_tabs(state, tabs, chosen, distance, room);
  if (std::ranges::find(fit, false) == fit.end()) return fit;
  return fitting_tabs(state, tabs, chosen, distance, room - distance - ImGui::CalcTextSize(kMoreTabs).x);
}

std::string names_of(std::span<Panel* const> panels) {
  std::string names;
  for (const Panel* panel : panels) names += (names.empty() ? "" : ", ") + std::string(panel->info().label);
  return names;
}

// A button at the right end of the line that lists the hidden tabs. Returns the tab that was chosen.
Panel* draw_hidden_tabs(AppState& state, std::span<Panel* const> hidden, float end) {
  constexpr const char* kHiddenTabs = "##more-tabs";
  const float width = ImGui::CalcTextSize(kMoreTabs).x;
  ImGui::SameLine(end - width);
  if (ImGui::Selectable(kMoreTabs, false, 0, {width, 0})) ImGui::OpenPopup(kHiddenTabs);
  state.ui.items.add("layout.more-tabs");
  if (ImGui::IsItemHovered()) tooltip(state.ui, "More panels: " + names_of(hidden));
  ImGui::SetNextWindowPos({ImGui::GetItemRectMax().x, ImGui::GetItemRectMin().y}, ImGuiCond_Appearing, {1, 1});
  if (!ImGui::BeginPopup(kHiddenTabs)) return nullptr;
  Panel* chosen = nullptr;
  for (Panel* panel : hidden) {
    const PanelInfo info = panel->info();
    if (ImGui::MenuItem(info.label, nullptr, state.panels.is_detached(*panel))) chosen = panel;
    state.ui.items.add(std::string("more-tabs.") + info.name);
    if (ImGui::IsItemHovered()) tooltip(state.ui, info.description);
  }
  ImGui::EndPopup();
  return chosen;
}

// The upper side resizes an open panel. Returns whether the pointer is there.
bool draw_resize_grip(AppState& state, float top, float right, float bottom) {
  const ImVec2 start = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({0, top});
  ImGui::InvisibleButton("##grip", {right, tab_padding(state).y});
  state.ui.items.add("layout.bottom-panel");
  const bool active = ImGui::IsItemActive();
  const bool hovered = ImGui::IsItemHovered();
  if (active || hovered) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddLine({0, top + 1}, {right, top + 1}, ImGui::GetColorU32(state.ui.theme.accent), 2);
    if (hovered) tooltip(state.ui, "Drag to change the height; double-click to reset it");
  }
  if (active && ImGui::IsMouseDragging(0))  // not by the clicks that reset it
    state.settings.bottom_panel_height = (bottom - state.ui.input.mouse.y) / state.ui.scale;
  if (hovered && ImGui::IsMouseDoubleClicked(0)) state.settings.bottom_panel_height = 0;
  ImGui::SetCursorScreenPos(start);
  return active || hovered;
}

void draw_tabs(AppState& state, float top, float right, float bottom, bool resizable) {
  begin_window("##bottom-tabs", {0, top}, {right, tab_height(state)}, tab_padding(state));
  const bool shows_dots = resizable && !draw_resize_grip(state, top, right, bottom);
  const std::vector<Panel*> tabs = bottom_panels(state);
  const float room = right - 2 * tab_padding(state).x, distance = tab_distance(tabs, room);
  ChosenTab chosen;
  for (Panel* tab : tabs)
    if (state.ui.items.scroll_target() == tab->info().name) chosen.set(*tab);
  const std::vector<bool> shown = shown_tabs(state, tabs, chosen.get(), distance, room);
  std::vector<Panel*> hidden;
  bool is_first = true;
  for (size_t i = 0; i < tabs.size(); ++i) {
    if (!shown[i]) {
      hidden.push_back(tabs[i]);
      continue;
    }
    if (!is_first) ImGui::SameLine(0, distance);
    is_first = false;
    draw_tab(state, *tabs[i]);
  }
  Panel* opened = hidden.empty() ? nullptr : draw_hidden_tabs(state, hidden, right - tab_padding(state).x);
  if (opened) {
    chosen.set(*opened);
    state.panels.toggle(*opened);
  }
  const float scale = state.ui.scale;
  if (shows_dots)
    draw_grip_dots(ImGui::GetWindowDrawList(), {right / 2, top + 2.5f * scale}, {6 * scale, 0}, state.ui.theme);
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
    draw_tabs(state, bottom - tab_height(state), right, bottom, false);
    return bottom - tab_height(state);
  }
  const float panel_top = bottom - panel_height(state, bottom - top);
  draw_tabs(state, panel_top, right, bottom, true);
  const float content_top = panel_top + tab_height(state);
  begin_window("##bottom-panel", {0, content_top}, {right, bottom - content_top}, tab_padding(state));
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
