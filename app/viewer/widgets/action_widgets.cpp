#include "viewer/widgets/action_widgets.h"

#include <imgui.h>

#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/basic_widgets.h"

namespace etendue::viewer {

void action_button(AppState& state, const char* name) {
  const Action* action = state.actions.find(name);
  const bool checked = action->is_checked(state);
  ImGui::BeginDisabled(!action->is_enabled(state));
  if (checked) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
  const bool pressed = ImGui::Button(action->label.c_str());
  if (checked) ImGui::PopStyleColor();
  ImGui::EndDisabled();
  state.ui.items.add(name);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    const std::string keys = label(action->chords());
    tooltip(state.ui, action->tooltip + (keys.empty() ? "" : " (" + keys + ")"));
  }
  if (pressed) action->run(state);
}

void action_menu_item(AppState& state, const Action& action) {
  std::string text = action.label;
  const Editor& editor = *state.editor;
  if (action.name == "edit.undo" && !editor.undo_name().empty()) text += ": " + editor.undo_name();
  if (action.name == "edit.redo" && !editor.redo_name().empty()) text += ": " + editor.redo_name();
  const std::string keys = label(action.chords());
  const bool chosen = ImGui::MenuItem(text.c_str(), keys.c_str(), action.is_checked(state), action.is_enabled(state));
  state.ui.items.add(action.name);
  // A panel may have a button of the same name.
  state.ui.items.add("entry." + action.name);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) tooltip(state.ui, action.tooltip);
  if (chosen) action.run(state);
}

}  // namespace etendue::viewer
