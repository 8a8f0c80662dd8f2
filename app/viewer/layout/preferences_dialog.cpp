#include "viewer/layout/preferences_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "viewer/files/file_request.h"
#include "viewer/state/app_state.h"
#include "viewer/state/preferences.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/dialog.h"
#include "viewer/widgets/parameter_field.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr const char* kName = "##preferences";

void preference_widgets(AppState& state, const std::vector<ParameterInfo>& parameters) {
  for (const ParameterInfo& info : parameters)
    if (const auto value = parameter_widget(state, info)) set_preference(state, info.name, *value);
}

// A text field for a folder. Its text is used while it is typed, and kept when editing ends.
void draw_folder(AppState& state, const ParameterInfo& info) {
  std::string folder = std::get<std::string>(info.default_value);
  ImGui::PushID(info.name.c_str());
  parameter_label(state.ui, info.name, info.label);
  if (ImGui::InputTextWithHint("##folder", info.option_labels.front().c_str(), &folder))
    assign_preference(state.settings, info.name, folder);
  if (ImGui::IsItemDeactivatedAfterEdit()) state.store_settings();
  describe_item(state.ui, info);
  if (parameter_menu(state, info)) set_preference(state, info.name, *default_preference(info.name));
  if (const auto value = take_requested_value(state.ui, info)) set_preference(state, info.name, *value);
  std::error_code code;
  if (!folder.empty() && !std::filesystem::is_directory(folder, code)) warning(state.ui, "This folder does not exist.");
  ImGui::PopID();
}

void draw_files(AppState& state) {
  for (const ParameterInfo& info : folder_preferences(state.settings)) draw_folder(state, info);
  ImGui::BeginDisabled(state.settings.recent.empty());
  if (ImGui::Button("Clear recent files")) {
    state.settings.recent.clear();
    state.store_settings();
  }
  ImGui::EndDisabled();
  state.ui.items.add("preferences.clear-recent");
}

void set_shortcut(AppState& state, const std::string& action, const std::string& shortcut) {
  state.actions.set_shortcut(action, shortcut);
  const Action* changed = state.actions.find(action);
  if (changed->shortcut == changed->default_shortcut)
    state.settings.shortcuts.erase(action);
  else
    state.settings.shortcuts[action] = changed->shortcut;
  state.store_settings();
}

void reset_all_shortcuts(AppState& state) {
  const auto changed = state.settings.shortcuts;
  for (const auto& [name, shortcut] : changed)
    if (const Action* action = state.actions.find(name)) set_shortcut(state, name, action->default_shortcut);
}

}  // namespace

void set_preference(AppState& state, const std::string& name, const Value& value) {
  assign_preference(state.settings, name, value);
  state.interface.style_is_outdated = true;
  state.store_settings();
}

void show_preference(AppState& state, const std::string& name) {
  state.interface.preferences_open = true;
  state.ui.items.point_out(name);
}

void PreferencesDialog::capture_shortcut(AppState& state) {
  const Input& input = state.ui.input;
  if (capturing_.empty()) return;
  const auto chord = pressed_chord(input);
  if (!chord) return;
  const std::string action = capturing_;
  capturing_.clear();
  const std::string text = shortcut_text(*chord);
  if (text == "escape" || text.empty()) return;
  if (text == "delete" || text == "backspace") return set_shortcut(state, action, "");
  // A chord has one action.
  if (const Action* other = state.actions.find_conflict(action, *chord)) {
    state.notices.add_message(label(*chord) + " was the shortcut of " + other->label);
    set_shortcut(state, other->name, "");
  }
  set_shortcut(state, action, text);
}

void PreferencesDialog::draw_shortcut(AppState& state, const Action& action) {
  ImGui::PushID(action.name.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(action.label.c_str());
  if (ImGui::IsItemHovered()) tooltip(state.ui, action.tooltip);
  ImGui::TableNextColumn();
  const bool is_capturing = capturing_ == action.name;
  const std::string keys = is_capturing ? "Press keys..." : label(action.chords());
  if (ImGui::Button((keys + "##shortcut").c_str(), {-1, 0})) capturing_ = action.name;
  state.ui.items.add("preferences.shortcut." + action.name);
  if (ImGui::IsItemHovered())
    tooltip(state.ui, is_capturing ? "Press the new keys. Delete removes the shortcut, Escape keeps it"
                                   : "Click, then press the new keys");
  ImGui::TableNextColumn();
  if (action.shortcut != action.default_shortcut) {
    if (ImGui::SmallButton("Reset")) set_shortcut(state, action.name, action.default_shortcut);
  }
  ImGui::PopID();
}

void PreferencesDialog::draw_keyboard(AppState& state) {
  capture_shortcut(state);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.6f);
  ImGui::InputTextWithHint("##filter", "Filter", &filter_);
  ImGui::SameLine();
  ImGui::BeginDisabled(state.settings.shortcuts.empty());
  if (ImGui::Button("Reset all")) reset_all_shortcuts(state);
  ImGui::EndDisabled();
  state.ui.items.add("preferences.reset-shortcuts");
  ImGui::BeginChild("##shortcuts");
  if (ImGui::BeginTable("##table", 3, ImGuiTableFlags_SizingStretchProp)) {
    const float em = ImGui::GetFontSize();
    ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, em * 11);
    ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, em * 3.5f);
    const std::string searched = lower_case(filter_);
    for (const Action& action : state.actions.all())
      if (lower_case(action.label + " " + label(action.chords())).find(searched) != std::string::npos)
        draw_shortcut(state, action);
    ImGui::EndTable();
  }
  ImGui::EndChild();
}

void PreferencesDialog::draw(AppState& state) {
  bool& open = state.interface.preferences_open;
  if (!open) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  if (!begin_dialog(kName, {std::min(screen.x * 0.9f, em * 34), std::min(screen.y * 0.85f, em * 36)})) return;
  const bool is_appearing = ImGui::IsWindowAppearing();
  ImGui::TextColored(state.ui.theme.accent, "Preferences");
  const bool was_capturing = !capturing_.empty();
  const float footer = ImGui::GetFrameHeightWithSpacing();
  ImGui::BeginChild("##content", {0, -footer});
  if (ImGui::BeginTabBar("##tabs")) {
    const bool shows_widget = is_appearing && !state.ui.items.pointed_out().empty();
    if (ImGui::BeginTabItem("Interface", nullptr, shows_widget ? ImGuiTabItemFlags_SetSelected : 0)) {
      preference_widgets(state, interface_preferences(state.settings));
      ImGui::Spacing();
      preference_widgets(state, rendering_preferences(state.settings));
      draw_files(state);
      ImGui::EndTabItem();
    }
    bool& is_requested = state.interface.keyboard_is_requested;
    const ImGuiTabItemFlags flags = is_requested ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None;
    is_requested = false;
    if (ImGui::BeginTabItem("Keyboard", nullptr, flags)) {
      draw_keyboard(state);
      ImGui::EndTabItem();
    }
    state.ui.items.add("preferences.keyboard");
    ImGui::EndTabBar();
  }
  ImGui::EndChild();
  const bool escaped = !was_capturing && escape_is_pressed();
  if (ImGui::Button("Close") || escaped) {
    open = false;
    capturing_.clear();
    ImGui::CloseCurrentPopup();
  }
  state.ui.items.add("preferences.close");
  ImGui::EndPopup();
}

}  // namespace etendue::viewer
