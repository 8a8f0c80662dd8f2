#include "viewer/widgets/parameter_field.h"
#include "viewer/platform/platform.h"

#include <imgui.h>

#include <utility>

#include "integrator/integrator.h"
#include "render/document.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/basic_widgets.h"

namespace etendue::viewer {
namespace {

// How an option is shown in a list: its group, and its tooltip. Only integrators and reflection models have groups.
struct OptionDescription {
  const char* group = nullptr;
  const char* group_tooltip = "";
  const char* tooltip = "";
};

OptionDescription describe_option(const ParameterInfo& info, const std::string& option) {
  if (info.name.ends_with("integrator"))
    if (const auto* integrator = integrator::find_integrator(option)) {
      const auto& group = integrator::info_of(integrator->group);
      return {.group = group.label, .group_tooltip = group.doc, .tooltip = integrator->summary.c_str()};
    }
  if (info.name.ends_with(".model"))
    if (const auto* model = find_bsdf_model(option)) {
      const auto kind = static_cast<size_t>(model->description.model_class);
      return {.group = Options<ModelClass>::kOptions[kind].label, .tooltip = model->description.summary};
    }
  return {};
}

}  // namespace

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

namespace {

struct ListedOption {
  size_t index;  // in ParameterInfo::options
  OptionDescription description;
};

// The options in their order, but those of a group together, where its first one is.
std::vector<ListedOption> options_by_group(const ParameterInfo& info) {
  std::vector<ListedOption> list;
  for (size_t i = 0; i < info.options.size(); ++i) {
    const ListedOption option{i, describe_option(info, info.options[i])};
    const auto in_same_group = [&](const ListedOption& o) { return o.description.group == option.description.group; };
    const auto last = std::find_if(list.rbegin(), list.rend(), in_same_group);
    list.insert(option.description.group && last != list.rend() ? last.base() : list.end(), option);
  }
  return list;
}

}  // namespace

std::optional<Value> option_list(UiContext& ui, const ParameterInfo& info, size_t selected) {
  std::optional<Value> chosen;
  const char* group = nullptr;
  for (const auto& [i, option] : options_by_group(info)) {
    if (option.group && std::exchange(group, option.group) != option.group) {
      ImGui::TextColored(ui.theme.secondary_text, "%s", option.group);
      if (ImGui::IsItemHovered()) tooltip(ui, option.group_tooltip);
    }
    const float indent = ImGui::GetFontSize() * 0.6f;
    if (option.group) ImGui::Indent(indent);
    if (ImGui::Selectable(info.option_labels[i].c_str(), i == selected)) chosen = info.options[i];
    ui.items.add(info.name + "=" + info.options[i]);
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
