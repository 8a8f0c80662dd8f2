// What can be done? Every action that has a menu, with its keys; what was opened lately.
#include <imgui.h>

#include <filesystem>
#include <utility>

#include "viewer/layout/interface.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

void action_item(Workbench& w, const Action& action) {
  std::string keys;
  for (const Chord& chord : action.chords()) keys += (keys.empty() ? "" : ", ") + label(chord);
  std::string text = action.label;
  if (action.name == "edit.undo" && !w.editor.undo_name().empty()) text += ": " + w.editor.undo_name();
  if (action.name == "edit.redo" && !w.editor.redo_name().empty()) text += ": " + w.editor.redo_name();
  if (ImGui::MenuItem(text.c_str(), keys.c_str(), action.checked && action.checked(), action.is_enabled()))
    action.run();
  w.items.place(action.name);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) tooltip(w, action.doc);
}

void heading(const Workbench& w, const Action& action) {
  ImGui::Separator();
  ImGui::PushFont(w.faces.small);
  ImGui::TextColored(w.theme.quiet, "%s", action.heading.c_str());
  ImGui::PopFont();
  if (ImGui::IsItemHovered()) tooltip(w, action.heading_doc);
}

void recent_files(Workbench& w) {
  if (!ImGui::BeginMenu("Recent", !w.settings.recent.empty())) return;
  for (const auto& file : std::vector<std::string>(w.settings.recent)) {
    if (ImGui::MenuItem(std::filesystem::path(file).filename().c_str())) w.open(file);
    if (ImGui::IsItemHovered()) tooltip(w, file);
  }
  ImGui::EndMenu();
}

void title(Workbench& w) {
  const auto& d = w.editor.document();
  std::string text = std::filesystem::path(d.scene_name).filename().string();
  if (w.editor.undo_depth() > 0) text += " (edited)";
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  const float at = 0.5f * (ImGui::GetWindowWidth() - width);
  const Action* palette = w.actions.find("app.palette");
  const std::string hint = "Ctrl+K  find an action";
  const float hint_width = ImGui::CalcTextSize(hint.c_str()).x + 2 * ImGui::GetStyle().ItemSpacing.x;
  const float hint_at = ImGui::GetWindowWidth() - hint_width - ImGui::GetStyle().WindowPadding.x;
  if (at > ImGui::GetCursorPosX() && at + width < hint_at) {
    ImGui::SetCursorPosX(at);
    ImGui::TextUnformatted(text.c_str());
  }
  if (hint_at < ImGui::GetCursorPosX()) return;
  ImGui::SetCursorPosX(hint_at);
  ImGui::PushStyleColor(ImGuiCol_Text, w.theme.quiet);
  if (ImGui::Selectable(hint.c_str(), false, 0, {hint_width, 0})) palette->run();
  ImGui::PopStyleColor();
  w.items.place("menu.palette");
}

}  // namespace

void draw_menu_bar(Workbench& w) {
  if (!ImGui::BeginMainMenuBar()) return;
  for (const char* menu : {"File", "Edit", "View", "Compare", "Integrator", "Render", "Help"}) {
    const bool open = ImGui::BeginMenu(menu);
    w.items.place(std::string("menu.") + static_cast<char>(std::tolower(menu[0])) + (menu + 1));
    if (!open) continue;
    std::string part;
    for (const auto& action : w.actions.all()) {
      if (action.menu != menu) continue;
      if (action.heading != std::exchange(part, action.heading)) heading(w, action);
      action_item(w, action);
      if (action.name == "file.open") recent_files(w);
    }
    ImGui::EndMenu();
  }
  if (!w.editor.empty()) title(w);
  ImGui::EndMainMenuBar();
}

}  // namespace etendue::viewer
