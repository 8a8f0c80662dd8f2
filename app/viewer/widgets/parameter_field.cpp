#include "viewer/widgets/parameter_field.h"

#include <imgui.h>

#include <utility>

#include "render/document.h"
#include "viewer/panels/panel.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/state/preferences.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/option_groups.h"

namespace etendue::viewer {
namespace {

bool is_numeric(const ParameterInfo& info) {
  return info.type == ParameterType::number || info.type == ParameterType::integer;
}

bool is_of_document(const AppState& state, const std::string& name) {
  return state.has_document() && static_cast<bool>(render::get(state.document(), name));
}

}  // namespace

std::string value_label(const ParameterInfo& info, const Value& value) {
  for (size_t i = 0; i < info.options.size(); ++i)
    if (value == Value(info.options[i])) return info.option_labels[i];
  if (!is_numeric(info)) return to_string(value);
  ParameterInfo shown = info;
  shown.default_value = value;
  return number_label(shown);
}

std::optional<Value> take_requested_value(UiContext& ui, const ParameterInfo& info) {
  const auto text = ui.items.take_request(info.name);
  if (!text) return std::nullopt;
  auto value = parse_value(info, *text);
  ui.items.answer(value ? "" : value.error().message);
  if (!value) return std::nullopt;
  return *value;
}

float parameter_label(UiContext& ui, const std::string& name, const std::string& label, float least_width) {
  const float room = label_column(label, least_width);
  ui.items.add_text(name, room > 0);
  return room;
}

void describe_item(UiContext& ui, const ParameterInfo& info, const std::function<std::string()>& hint) {
  ui.items.add(info.name);
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsItemActive()) return;
  if (ui.pointer_rest < kTooltipDelay) return;
  const bool is_enabled = ImGui::IsItemHovered();
  std::string text = info.label + ": " + info.doc;
  if (is_numeric(info)) text += "\n" + range_text(info);
  if (hint && is_enabled) text += "\n" + hint();
  text += "\n" + info.name;
  tooltip(ui, text);
  ui.items.set_tooltip(text);
}

WidgetEdit number_field(AppState& state, const ParameterInfo& info, float drag_speed, const std::string& stored) {
  UiContext& ui = state.ui;
  ImGui::PushFont(ui.fonts.monospace);
  ui.items.add_text(info.name, ImGui::CalcTextSize(number_label(info).c_str()).x <= ImGui::CalcItemWidth());
  WidgetEdit edit = number_widget(info, drag_speed);
  ImGui::PopFont();
  describe_item(ui, info, [&] {
    const bool can_be_reset = reset_value(state, stored.empty() ? info.name : stored).has_value();
    return std::string("Double click: enter a value") + (can_be_reset ? ". Ctrl+click: reset" : "");
  });
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

std::optional<Value> reset_value(const AppState& state, const std::string& name) {
  if (auto preference = default_preference(name)) return preference;
  if (!state.has_document()) return std::nullopt;
  if (auto original = original_value(state, name)) return original;
  for (const auto& panel : state.panels.all())
    if (auto value = panel->default_value(state, name)) return value;
  return std::nullopt;
}

bool parameter_menu(AppState& state, const ParameterInfo& info) {
  if (!ImGui::BeginPopupContextItem("##menu")) return false;
  const bool of_document = is_of_document(state, info.name);
  const auto value_after = reset_value(state, info.name);
  const std::string reset_label = value_after ? "Reset to " + value_label(info, *value_after) : "Reset";
  bool reset = false;
  if (value_after || of_document) {
    const bool is_changed = value_after && *value_after != info.default_value;
    reset = ImGui::MenuItem(reset_label.c_str(), is_numeric(info) ? "Ctrl+click" : nullptr, false, is_changed);
    state.ui.items.add("menu.reset");
  }
  const std::string value = to_string(info.default_value);
  if (ImGui::MenuItem("Copy value")) state.platform.set_clipboard(value);
  if (ImGui::MenuItem("Copy name")) state.platform.set_clipboard(info.name);
  if (of_document) {
    if (ImGui::MenuItem("Copy as command-line option"))
      state.platform.set_clipboard("--set " + info.name + "=" + value);
    state.ui.items.add("menu.copy-option");
  }
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
