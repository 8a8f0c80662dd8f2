#include "viewer/layout/command_palette.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <vector>

#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

bool matches(const Action& action, const std::string& text) {
  const std::string searched = action.label + " " + action.name + " " + action.menu + " " + action.tooltip;
  return lower_case(searched).find(lower_case(text)) != std::string::npos;
}

// One line of the list: label, menu and shortcut. Returns true if it was clicked.
bool draw_action(AppState& state, const Action& action, bool is_selected) {
  const float em = ImGui::GetFontSize();
  ImGui::PushID(action.name.c_str());
  const bool clicked = ImGui::Selectable("##action", is_selected);
  state.ui.items.add("palette." + action.name);
  if (ImGui::IsItemHovered()) tooltip(state.ui, action.tooltip + "\n" + action.name);
  ImGui::SameLine(0, 0);
  ImGui::TextUnformatted(action.label.c_str());
  ImGui::SameLine(em * 18);
  ImGui::TextDisabled("%s", action.menu.c_str());
  ImGui::SameLine(em * 24);
  ImGui::TextDisabled("%s", label(action.chords()).c_str());
  ImGui::PopID();
  return clicked;
}

bool key_pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

}  // namespace

void CommandPalette::draw(AppState& state) {
  bool& open = state.interface.palette_open;
  if (open && !ImGui::IsPopupOpen("##palette")) {
    ImGui::OpenPopup("##palette");
    text_.clear();
    selected_ = 0;
  }
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({screen.x / 2, screen.y * 0.12f}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({std::min(screen.x * 0.9f, em * 34), std::min(screen.y * 0.7f, em * 24)});
  if (!ImGui::BeginPopup("##palette")) {
    open = false;
    return;
  }
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered =
      ImGui::InputTextWithHint("##text", "Find a command", &text_, ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemEdited()) selected_ = 0;
  std::vector<const Action*> found;
  for (const auto& action : state.actions.all())
    if (action.is_enabled(state) && matches(action, text_)) found.push_back(&action);
  if (key_pressed(ImGuiKey_DownArrow) && selected_ + 1 < found.size()) ++selected_;
  if (key_pressed(ImGuiKey_UpArrow) && selected_ > 0) --selected_;
  const Action* chosen = entered && selected_ < found.size() ? found[selected_] : nullptr;
  ImGui::BeginChild("##found");
  for (size_t i = 0; i < found.size(); ++i)
    if (draw_action(state, *found[i], i == selected_)) chosen = found[i];
  if (found.empty()) ImGui::TextDisabled("No matching command");
  ImGui::EndChild();
  if (chosen || key_pressed(ImGuiKey_Escape)) {
    open = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  if (chosen) chosen->run(state);
}

}  // namespace etendue::viewer
