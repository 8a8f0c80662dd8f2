#include "viewer/layout/viewport_menu.h"

#include <imgui.h>

#include "render/document.h"
#include "viewer/panels/object_names.h"
#include "viewer/state/app_state.h"
#include "viewer/viewport/viewport.h"
#include "viewer/widgets/action_widgets.h"

namespace etendue::viewer {
namespace {

constexpr const char* kViewportMenu = "##viewport-menu";

void panel_item(AppState& state, const char* label, const char* panel) {
  if (ImGui::MenuItem(label)) state.panels.open(*state.panels.find(panel));
  state.ui.items.add(std::string("viewport-menu.") + panel);
}

// Entries for the selected object.
void draw_object_items(AppState& state) {
  const Selection selection = state.selection;
  // An entry may replace the scene of the document.
  const auto scene = state.document().scene;
  const auto& nodes = scene->nodes;
  if (selection.node < 0 || static_cast<size_t>(selection.node) >= nodes.size()) return;
  const auto& node = nodes[static_cast<size_t>(selection.node)];
  ImGui::TextDisabled("%s", object_name(node.name, "object", static_cast<size_t>(selection.node)).c_str());
  action_menu_item(state, *state.actions.find("view.frame-selection"));
  for (const char* action : {"object.duplicate", "object.delete"}) action_menu_item(state, *state.actions.find(action));
  if (ImGui::MenuItem("Hide")) state.set_parameter("node." + std::to_string(selection.node) + ".visible", false);
  state.ui.items.add("viewport-menu.hide");
  if (selection.material >= 0) panel_item(state, "Material", "tab.material");
  if (node.light >= 0) panel_item(state, "Light", "tab.light");
  panel_item(state, "Transform", "tab.scene");
  ImGui::Separator();
}

}  // namespace

void draw_viewport_menu(AppState& state) {
  auto& position = state.interface.menu_position;
  if (position) {
    select_at(state, *position);
    state.interface.menu_target = *position;
    position.reset();
    ImGui::OpenPopup(kViewportMenu);
  }
  if (!ImGui::BeginPopup(kViewportMenu)) return;
  draw_object_items(state);
  if (ImGui::MenuItem("Focus and orbit here", "double click")) focus_at(state, state.interface.menu_target);
  state.ui.items.add("viewport-menu.focus");
  for (const char* action : {"view.frame-all", "view.reset-camera", "display.next-aov", "display.toggle-false-color",
                             "compare.pin", "snapshot.save", "snapshot.save-as"})
    action_menu_item(state, *state.actions.find(action));
  ImGui::EndPopup();
}

}  // namespace etendue::viewer
