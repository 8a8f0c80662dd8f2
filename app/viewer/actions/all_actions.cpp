#include "viewer/actions/all_actions.h"

#include "viewer/actions/conditions.h"

namespace etendue::viewer {

void add_panel_actions(ActionList& actions, const PanelSet& panels) {
  for (const auto& panel : panels.all()) panel->add_actions(actions);
  for (const auto& owned : panels.all()) {
    Panel* panel = owned.get();
    const PanelInfo info = panel->info();
    const bool is_bottom = info.place == PanelPlace::bottom;
    actions.add({.name = std::string("view.") + info.name,
                 .menu = "View",
                 .label = info.label,
                 .tooltip = info.description,
                 .run = [panel](AppState& state) { state.panels.toggle(*panel); },
                 .enabled = has_document,
                 .checked = [panel](const AppState& state) { return state.panels.is_open(*panel); },
                 .section = "panels",
                 .submenu = is_bottom ? "Bottom panel" : "Side panel"});
  }
  actions.add({.name = "layout.detach",
               .menu = "View",
               .label = "Detach bottom panel",
               .tooltip = "Moves the bottom panel into a window of its own, which can be moved and resized. The context menu of "
                          "a tab does the same for any panel; closing the window returns it",
               .shortcut = "ctrl+shift+d",
               .run =
                   [](AppState& state) {
                     if (Panel* panel = state.panels.open_bottom_panel()) state.panels.detach(*panel);
                   },
               .enabled = [](const AppState& state) { return state.panels.open_bottom_panel() != nullptr; },
               .section = "panels"});
}

void add_all_actions(ActionList& actions, const PanelSet& panels) {
  add_file_actions(actions);
  add_edit_actions(actions);
  add_view_actions(actions);
  add_zoom_actions(actions);
  add_object_actions(actions);
  add_material_actions(actions);
  add_render_actions(actions);
  add_integrator_actions(actions);
  add_inspection_actions(actions);
  add_panel_actions(actions, panels);
  add_comparison_actions(actions);
}

}  // namespace etendue::viewer
