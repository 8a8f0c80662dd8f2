#include "viewer/layout/menu_bar.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <span>
#include <vector>

#include "render/document.h"
#include "viewer/files/file_names.h"
#include "viewer/state/document_info.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr const char* kMenus[] = {"File", "Edit", "View", "Compare", "Integrator", "Render", "Help"};

// A line, and the heading if there is one.
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

// An action, or the submenu of several actions.
void draw_entries(AppState& state, std::span<const Action* const> entries) {
  const Action& first = *entries.front();
  if (first.submenu.empty()) {
    action_menu_item(state, first);
    if (first.name == "file.open") draw_recent_files(state);
    return;
  }
  const bool open = ImGui::BeginMenu(first.submenu.c_str());
  state.ui.items.add("submenu." + lower_case(first.submenu));
  if (!open) return;
  for (const Action* action : entries) action_menu_item(state, *action);
  ImGui::EndMenu();
}

// Moves the entries of a section and those of a submenu to the first of them. Their order is that of registration.
void gather_sections(std::vector<const Action*>& entries) {
  const auto gather = [&](auto is_like) {
    for (auto first = entries.begin(); first != entries.end(); ++first)
      std::stable_partition(first + 1, entries.end(), [&](const Action* other) { return is_like(**first, *other); });
  };
  gather([](const Action& a, const Action& b) { return a.group == b.group && a.section == b.section; });
  gather([](const Action& a, const Action& b) { return !a.submenu.empty() && a.submenu == b.submenu; });
}

void draw_menu(AppState& state, const char* menu) {
  limit_height_of_next_menu();
  const bool open = ImGui::BeginMenu(menu);
  state.ui.items.add("menu." + lower_case(menu));
  if (!open) return;
  std::vector<const Action*> entries;
  for (const auto& action : state.actions.all())
    if (action.menu == menu) entries.push_back(&action);
  gather_sections(entries);
  std::string group, section;
  for (size_t i = 0; i < entries.size();) {
    const Action& action = *entries[i];
    if (action.group != group)
      draw_group_heading(state.ui, action);
    else if (action.section != section && i > 0)
      ImGui::Separator();
    group = action.group;
    section = action.section;
    const auto same_submenu = [&](const Action* other) { return other->submenu == action.submenu; };
    const size_t count = action.submenu.empty() ? 1 : static_cast<size_t>(std::ranges::count_if(entries, same_submenu));
    draw_entries(state, std::span(entries).subspan(i, count));
    i += count;
  }
  ImGui::EndMenu();
}

// The name of the scene in the middle, and the command palette on the right, as far as there is space.
void draw_title(AppState& state) {
  std::string title = title_of(state.document(), state.files.session_file);
  if (state.editor->has_unsaved_scene_edits()) title += " (edited)";
  const std::string hint = label(state.actions.find("app.palette")->chords()) + "  Find a command";
  const ImGuiStyle& style = ImGui::GetStyle();
  const float window_width = ImGui::GetWindowWidth();
  const float title_width = ImGui::CalcTextSize(title.c_str()).x;
  const float title_x = 0.5f * (window_width - title_width);
  const float hint_width = ImGui::CalcTextSize(hint.c_str()).x + 2 * style.ItemSpacing.x;
  const float hint_x = window_width - hint_width - style.WindowPadding.x;
  if (title_x > ImGui::GetCursorPosX() && title_x + title_width < hint_x) {
    ImGui::SetCursorPosX(title_x);
    ImGui::TextUnformatted(title.c_str());
  }
  if (hint_x < ImGui::GetCursorPosX()) return;
  ImGui::SetCursorPosX(hint_x);
  ImGui::PushStyleColor(ImGuiCol_Text, state.ui.theme.secondary_text);
  if (ImGui::Selectable(hint.c_str(), false, 0, {hint_width, 0})) state.interface.palette_open = true;
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
