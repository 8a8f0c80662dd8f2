// Undo, redo and selection.
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {

void add_edit_actions(ActionList& actions) {
  actions.add({.name = "edit.undo",
               .menu = "Edit",
               .label = "Undo",
               .tooltip = "Reverts the last edit",
               .shortcut = "ctrl+z",
               .run = [](AppState& state) { state.editor->undo(); },
               .enabled = [](const AppState& state) { return state.editor->undo_depth() > 0; }});
  actions.add({.name = "edit.redo",
               .menu = "Edit",
               .label = "Redo",
               .tooltip = "Repeats the edit that was reverted last",
               .shortcut = "ctrl+shift+z",
               .run = [](AppState& state) { state.editor->redo(); },
               .enabled = [](const AppState& state) { return state.editor->redo_depth() > 0; }});
  actions.add(
      {.name = "edit.deselect",
       .menu = "Edit",
       .label = "Deselect all",
       .tooltip = "Clears the selection and the region of interest, and deactivates the tool for the next click",
       .shortcut = "escape",
       .run =
           [](AppState& state) {
             state.selection = {};
             state.viewport.click_tool.reset();
             state.viewport.focus.clear();
           },
       .enabled =
           [](const AppState& state) {
             const FocusRegion& focus = state.viewport.focus;
             return state.selection.node >= 0 || state.viewport.click_tool || focus.exists() || focus.is_selecting();
           }});
}

}  // namespace etendue::viewer
