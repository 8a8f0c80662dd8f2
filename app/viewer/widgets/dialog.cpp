#include "viewer/widgets/dialog.h"

#include "viewer/state/app_state.h"

namespace etendue::viewer {

bool begin_dialog(const char* name, const ImVec2& size) {
  if (!ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize;
  if (size.x > 0)
    ImGui::SetNextWindowSize(size);
  else
    flags |= ImGuiWindowFlags_AlwaysAutoResize;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  const bool is_drawn = ImGui::BeginPopupModal(name, nullptr, flags);
  ImGui::PopStyleVar();
  return is_drawn;
}

bool dialog_button(AppState& state, const char* label, const char* name) {
  const bool pressed = ImGui::Button(label);
  state.ui.items.add(name);
  return pressed;
}

bool escape_is_pressed() {
  const bool popup_is_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId);
  return !popup_is_open && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

}  // namespace etendue::viewer
