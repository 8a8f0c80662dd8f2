#include "viewer/widgets/parameter_field.h"

#include <imgui.h>

#include <utility>

#include "render/document.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/option_groups.h"

namespace etendue::viewer {

std::optional<Value> take_requested_value(UiContext& ui, const ParameterInfo& info) {
  const auto text = ui.items.take_request(info.name);
  if (!text) return std::nullopt;
  auto value = parse_value(info, *text);
  ui.items.answer(value ? "" : value.error().message);
  if (!value) return std::nullopt;
  return *value;
}

void describe_item(UiContext& ui, const ParameterInfo& info) {
  ui.items.add(info.name);
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsItemActive()) return;
  std::string text = info.label + ": " + info.doc;
  if (info.type == ParameterType::number || info.type == ParameterType::integer)
    text += "\n" + range_text(info) + "\nDouble click: enter a value. Ctrl+click: reset";
  tooltip(ui, text + "\n" + info.name);
}

WidgetEdit number_field(UiContext& ui, const ParameterInfo& info, float drag_speed) {
  ImGui::PushFont(ui.fonts.monospace);
  WidgetEdit edit = number_widget(info, drag_speed);
  ImGui::PopFont();
  describe_item(ui, info);
  if (edit.value) return edit;
  edit.value = take_requested_value(ui, info);
  edit.scripted = edit.value.has_value();
  return edit;
}

std::optional<Value> option_list(UiContext& ui, const ParameterInfo& info, size_t selected) {
  std::optional<Value> chosen;
  const char* group = nullptr;
  for (const ListedOption& option : options_by_group(info)) {
    if (option.group && std::exchange(group, option.group) != option.group) {
      ImGui::TextColored(ui.theme.secondary_text, "%s", option.group);
      if (ImGui::IsItemHovered()) tooltip(ui, option.group_tooltip);
    }
    const float indent = ImGui::GetFontSize() * 0.6f;
    if (option.group) ImGui::Indent(indent);
    if (ImGui::Selectable(info.option_labels[option.index].c_str(), option.index == selected))
      chosen = info.options[option.index];
    ui.items.add(info.name + "=" + info.options[option.index]);
    if (ImGui::IsItemHovered()) tooltip(ui, option.tooltip);
    if (option.group) ImGui::Unindent(indent);
  }
  return chosen;
}

std::optional<Value> original_value(const AppState& state, const std::string& name) {
  const auto& original = state.document().origin;
  if (!original) return std::nullopt;
  const auto value = render::get(*original, name);
  return value ? std::optional(*value) : std::nullopt;
}

bool parameter_menu(AppState& state, const ParameterInfo& info) {
  if (!ImGui::BeginPopupContextItem("##menu")) return false;
  const auto original = state.has_document() ? original_value(state, info.name) : std::nullopt;
  const bool is_changed = original && *original != info.default_value;
  const std::string reset_label = original ? "Reset to " + to_string(*original) : "Reset";
  const bool reset = ImGui::MenuItem(reset_label.c_str(), "Ctrl+click", false, is_changed);
  state.ui.items.add("menu.reset");
  const std::string value = to_string(info.default_value);
  if (ImGui::MenuItem("Copy value")) state.platform.set_clipboard(value);
  if (ImGui::MenuItem("Copy name")) state.platform.set_clipboard(info.name);
  if (ImGui::MenuItem("Copy as command-line option")) state.platform.set_clipboard("--set " + info.name + "=" + value);
  ImGui::EndPopup();
  return reset;
}

bool parameters_menu(AppState& state, std::span<const render::DocumentParameter> parameters, const std::string& label,
                     const std::string& text) {
  if (!ImGui::BeginPopupContextItem("##menu")) return false;
  bool is_changed = false;
  std::string values, options;
  for (const render::DocumentParameter& parameter : parameters) {
    const ParameterInfo& info = parameter.info;
    const auto original = original_value(state, info.name);
    is_changed = is_changed || (original && *original != info.default_value);
    const std::string value = to_string(info.default_value);
    values += (values.empty() ? "" : " ") + value;
    options += (options.empty() ? "--set " : " --set ") + info.name + "=" + value;
  }
  const std::string& first = parameters.front().info.name;
  const bool reset = ImGui::MenuItem("Reset", nullptr, false, is_changed);
  state.ui.items.add("menu.reset");
  if (ImGui::MenuItem("Copy values")) state.platform.set_clipboard(values);
  state.ui.items.add("menu.copy");
  if (!label.empty() && ImGui::MenuItem(label.c_str())) state.platform.set_clipboard(text);
  if (!label.empty()) state.ui.items.add("menu.copy-text");
  if (ImGui::MenuItem("Copy name")) state.platform.set_clipboard(first.substr(0, first.rfind('.')));
  if (ImGui::MenuItem("Copy as command-line options")) state.platform.set_clipboard(options);
  ImGui::EndPopup();
  return reset;
}

void reset_parameters(AppState& state, std::span<const render::DocumentParameter> parameters) {
  std::vector<Value> values;
  for (const render::DocumentParameter& parameter : parameters)
    values.push_back(original_value(state, parameter.info.name).value_or(parameter.info.default_value));
  state.edit(parameters, values, "");
}

void start_edit(AppState& state, const ParameterInfo& info, const WidgetEdit& edit, const std::string& gesture) {
  if (edit.scripted) state.editor->end_gesture();
  const bool changed = edit.value && *edit.value != info.default_value;
  if (edit.pressed) state.ui.changed_by_press = changed ? gesture : "";
  if (edit.starts_typing && state.ui.changed_by_press == gesture) state.editor->discard_step(gesture);
}

void apply_edit(AppState& state, const render::DocumentParameter& parameter, const WidgetEdit& edit) {
  const ParameterInfo& info = parameter.info;
  start_edit(state, info, edit, info.name);
  if (edit.reset) {
    const auto value = original_value(state, info.name);
    if (value && *value != info.default_value) state.edit(parameter, *value);
  } else if (edit.value && *edit.value != info.default_value) {
    state.edit(parameter, *edit.value, info.name);
  }
  if (edit.ended) state.editor->end_gesture();
}

}  // namespace etendue::viewer
