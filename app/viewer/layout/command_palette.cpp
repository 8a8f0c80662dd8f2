// How do I do this? Any action by a part of its name.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "viewer/layout/interface.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// All letters in their order, in the label, the name or the explanation; earlier is better.
bool matches(const Action& action, const std::string& wanted) {
  return wanted.empty() ||
         lower(action.label + " " + action.name + " " + action.menu + " " + action.doc).find(lower(wanted)) !=
             std::string::npos;
}

struct State {
  std::string wanted;
  size_t chosen = 0;
};

}  // namespace

void draw_palette(Workbench& w) {
  static State state;  // one window, one palette
  if (w.view.palette && !ImGui::IsPopupOpen("##palette")) {
    ImGui::OpenPopup("##palette");
    state = {};
  }
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({screen.x / 2, screen.y * 0.12f}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({std::min(screen.x * 0.9f, em * 34), std::min(screen.y * 0.7f, em * 24)});
  if (!ImGui::BeginPopup("##palette")) {
    w.view.palette = false;
    return;
  }
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered =
      ImGui::InputTextWithHint("##wanted", "Find an action", &state.wanted, ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemEdited()) state.chosen = 0;
  std::vector<const Action*> found;
  for (const auto& action : w.actions.all())
    if (action.is_enabled() && matches(action, state.wanted)) found.push_back(&action);
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow)) && state.chosen + 1 < found.size()) ++state.chosen;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow)) && state.chosen > 0) --state.chosen;
  const Action* run = entered && state.chosen < found.size() ? found[state.chosen] : nullptr;
  ImGui::BeginChild("##found");
  for (size_t i = 0; i < found.size(); ++i) {
    const Action& action = *found[i];
    std::string keys;
    for (const Chord& chord : action.chords()) keys += (keys.empty() ? "" : ", ") + label(chord);
    ImGui::PushID(action.name.c_str());
    if (ImGui::Selectable("##action", i == state.chosen)) run = &action;
    w.items.place("palette." + action.name);
    if (ImGui::IsItemHovered()) tooltip(w, action.doc + "\n" + action.name);
    ImGui::SameLine(0, 0);
    ImGui::TextUnformatted(action.label.c_str());
    ImGui::SameLine(em * 17);
    ImGui::TextDisabled("%s", action.menu.c_str());
    ImGui::SameLine(em * 23);
    ImGui::TextDisabled("%s", keys.c_str());
    ImGui::PopID();
  }
  if (found.empty()) ImGui::TextDisabled("No action is called so");
  ImGui::EndChild();
  if (run || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    w.view.palette = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  if (run) run->run();
}

}  // namespace etendue::viewer
