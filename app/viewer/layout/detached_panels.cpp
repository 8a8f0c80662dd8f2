#include "viewer/layout/detached_panels.h"

#include <imgui.h>

#include <algorithm>

#include "viewer/layout/right_column.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"

namespace etendue::viewer {
namespace {

constexpr float kStep = 2;                              // em between the corners of successive windows
const ImVec2 kColumnPanel{26, 32}, kWidePanel{52, 20};  // size of new windows, em

void draw_content(AppState& state, Panel& panel) {
  const PanelInfo info = panel.info();
  if (info.place == PanelPlace::right_column)
    draw_column_panel(state, panel, std::string("detached.") + info.name + ".filter",
                      state.interface.detached_filters[info.name]);
  else if (state.has_document())
    panel.draw(state);
  else
    note(state.ui, "No scene is open.");
}

void draw_window(AppState& state, Panel& panel, size_t index) {
  const PanelInfo info = panel.info();
  const float em = ImGui::GetFontSize(), step = kStep * em * static_cast<float>(index + 1);
  const Placement& region = state.viewport.region;
  const ImVec2 usual = info.place == PanelPlace::bottom ? kWidePanel : kColumnPanel;
  ImGui::SetNextWindowPos({region.corner.x + step, region.corner.y + step}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({std::min(usual.x * em, region.size.x), std::min(usual.y * em, region.size.y)},
                           ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSizeConstraints({12 * em, 8 * em}, ImGui::GetIO().DisplaySize);
  bool stays = true;
  const std::string title = std::string(info.label) + "###detached." + info.name;
  const bool is_visible =
      ImGui::Begin(title.c_str(), &stays, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  state.ui.items.add(std::string("detached.") + info.name, {{corner.x, corner.y}, {size.x, ImGui::GetFrameHeight()}});
  if (is_visible) draw_content(state, panel);
  ImGui::End();
  if (!stays) state.panels.attach(panel);
}

}  // namespace

void draw_detached_panels(AppState& state) {
  const std::vector<Panel*> panels = state.panels.detached();  // closing one changes the list
  for (size_t i = 0; i < panels.size(); ++i) draw_window(state, *panels[i], i);
}

void tab_menu(AppState& state, Panel& panel) {
  const PanelInfo info = panel.info();
  if (!ImGui::BeginPopupContextItem(info.name)) return;
  const bool is_detached = state.panels.is_detached(panel);
  if (ImGui::MenuItem(is_detached ? "Return to the tabs" : "Detach")) {
    if (is_detached)
      state.panels.attach(panel);
    else
      state.panels.detach(panel);
  }
  state.ui.items.add("tab-menu.detach");
  ImGui::EndPopup();
}

}  // namespace etendue::viewer
