#include "viewer/layout/menu_bar.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "render/document.h"
#include "viewer/files/file_names.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr const char* kMenus[] = {"File", "Edit", "View", "Compare", "Integrator", "Render", "Help"};

void draw_group_heading(const UiContext& ui, const Action& action) {
  ImGui::Separator();
  if (action.group.empty()) return;
  ImGui::PushFont(ui.fonts.small);
  ImGui::TextColored(ui.theme.secondary_text, "%s", action.group.c_str());
  ImGui::PopFont();
  if (ImGui::IsItemHovered()) tooltip(ui, action.group_tooltip);
}

void draw_recent_files(AppState& state) {
  if (!ImGui::BeginMenu("Recent files", !state.settings.recent.empty())) return;
  // Opening a file changes the list.
  const auto files = state.settings.recent;
  for (const auto& file : files) {
    if (ImGui::MenuItem(base_name(file).c_str())) state.open_file(file);
    if (ImGui::IsItemHovered()) tooltip(state.ui, file);
  }
  ImGui::EndMenu();
}

// A menu that does not fit below the menu bar would cover it, and the click that opens the menu would choose an item.
void limit_height_of_next_menu() {
  constexpr float kMargin = 8;
  const float height = ImGui::GetIO().DisplaySize.y - ImGui::GetFrameHeight() - kMargin;
  ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, std::max(height, 1.0f)});
}

void draw_menu(AppState& state, const char* menu) {
  limit_height_of_next_menu();
  const bool open = ImGui::BeginMenu(menu);
  state.ui.items.add("menu." + lower_case(menu));
  if (!open) return;
  std::string group;
  for (const auto& action : state.actions.all()) {
    if (action.menu != menu) continue;
    if (action.group != group) draw_group_heading(state.ui, action);
    group = action.group;
    action_menu_item(state, action);
    if (action.name == "file.open") draw_recent_files(state);
  }
  ImGui::EndMenu();
}

// The name of the scene in the middle, and the command palette on the right, as far as there is space.
void draw_title(AppState& state) {
  std::string title = base_name(state.document().scene_name);
  if (state.editor->undo_depth() > 0) title += " (edited)";
  const char* hint = "Ctrl+K  Find a command";
  const ImGuiStyle& style = ImGui::GetStyle();
  const float window_width = ImGui::GetWindowWidth();
  const float title_width = ImGui::CalcTextSize(title.c_str()).x;
  const float title_x = 0.5f * (window_width - title_width);
  const float hint_width = ImGui::CalcTextSize(hint).x + 2 * style.ItemSpacing.x;
  const float hint_x = window_width - hint_width - style.WindowPadding.x;
  if (title_x > ImGui::GetCursorPosX() && title_x + title_width < hint_x) {
    ImGui::SetCursorPosX(title_x);
    ImGui::TextUnformatted(title.c_str());
  }
  if (hint_x < ImGui::GetCursorPosX()) return;
  ImGui::SetCursorPosX(hint_x);
  ImGui::PushStyleColor(ImGuiCol_Text, state.ui.theme.secondary_text);
  if (ImGui::Selectable(hint, false, 0, {hint_width, 0})) state.interface.palette_open = true;
  ImGui::PopStyleColor();
  state.ui.items.add("menu.palette");
}

}  // namespace

void draw_menu_bar(AppState& state) {
  if (!ImGui::BeginMainMenuBar()) return;
  for (const char* menu : kMenus) draw_menu(state, menu);
  if (state.has_document()) draw_title(state);
  ImGui::EndMainMenuBar();
}

}  // namespace etendue::viewer
