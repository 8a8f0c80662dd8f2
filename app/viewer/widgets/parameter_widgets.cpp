#include "viewer/widgets/parameter_widgets.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "render/document.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/color_widget.h"
#include "viewer/widgets/parameter_field.h"
#include "viewer/widgets/value_text.h"
#include "viewer/widgets/vector_widgets.h"

namespace etendue::viewer {
namespace {

using Parameters = std::vector<render::DocumentParameter>;

// A combo box with the options. Without `preview` it is only a button.
void options_combo(UiContext& ui, const ParameterInfo& info, const char* preview, size_t selected, WidgetEdit& edit) {
  ImGuiComboFlags flags = ImGuiComboFlags_HeightLarge;
  if (!preview) flags |= ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft;
  if (!begin_combo("##options", preview, flags)) return;
  if (auto chosen = option_list(ui, info, selected)) edit.value = std::move(chosen);
  ImGui::EndCombo();
}

size_t index_of_option(const ParameterInfo& info) {
  const auto& current = std::get<std::string>(info.default_value);
  return static_cast<size_t>(std::ranges::find(info.options, current) - info.options.begin());
}

// The widths that a combo box or a text field with proposals needs for its options.
struct OptionWidths {
  float current = 0, largest = 0;
};

OptionWidths widths_of_options(const UiContext& ui, const ParameterInfo& info) {
  OptionWidths widths;
  if (info.type != ParameterType::choice) return widths;
  const float frame = 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight();
  if (info.validate_text) ImGui::PushFont(ui.fonts.monospace);
  for (size_t i = 0; i < info.options.size(); ++i) {
    const float width = std::ceil(ImGui::CalcTextSize(info.option_labels[i].c_str()).x + frame);
    widths.largest = std::max(widths.largest, width);
    if (info.default_value == Value(info.options[i])) widths.current = width;
  }
  if (info.validate_text) ImGui::PopFont();
  return widths;
}

// The tooltip of a combo box names the selected option if it is too narrow for it.
void describe_choice(UiContext& ui, const ParameterInfo& info, const std::string& preview) {
  const float room = ImGui::GetItemRectSize().x - ImGui::GetFrameHeight() - ImGui::GetStyle().FramePadding.x;
  if (ImGui::CalcTextSize(preview.c_str()).x <= room) return describe_item(ui, info);
  ParameterInfo complete = info;
  complete.doc += "\nSelected: " + preview;
  describe_item(ui, complete);
}

WidgetEdit choice_widget(UiContext& ui, const ParameterInfo& info) {
  WidgetEdit edit;
  const size_t selected = index_of_option(info);
  const auto& current = std::get<std::string>(info.default_value);
  const std::string& preview = selected < info.options.size() ? info.option_labels[selected] : current;
  options_combo(ui, info, preview.c_str(), selected, edit);
  describe_choice(ui, info, preview);
  return edit;
}

// What a text field shows for a value: the label of a proposal. An empty text stays empty.
std::string text_of_value(const ParameterInfo& info, const std::string& value) {
  const auto found = static_cast<size_t>(std::ranges::find(info.options, value) - info.options.begin());
  return value.empty() || found >= info.options.size() ? value : info.option_labels[found];
}

// The value for a text that was typed: a label stands for its proposal.
std::string value_of_text(const ParameterInfo& info, const std::string& text) {
  const auto found = static_cast<size_t>(std::ranges::find(info.option_labels, text) - info.option_labels.begin());
  return text.empty() || found >= info.options.size() ? text : info.options[found];
}

// A text field with a list of proposals. Errors of the text are shown while it is typed.
WidgetEdit text_widget(AppState& state, const ParameterInfo& info) {
  WidgetEdit edit;
  UiContext& ui = state.ui;
  const auto& current = std::get<std::string>(info.default_value);
  std::string shown = text_of_value(info, current);  // while the field is active, ImGui keeps the edited text itself
  // The context menu belongs to the field and its list.
  ImGui::BeginGroup();
  ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - ImGui::GetFrameHeight());
  ImGui::PushFont(ui.fonts.monospace);
  const std::string hint = info.option_labels.empty() ? "" : info.option_labels.front();
  const bool entered = ImGui::InputTextWithHint("##text", hint.c_str(), &shown, ImGuiInputTextFlags_EnterReturnsTrue);
  const std::string text = value_of_text(info, shown);
  ImGui::PopFont();
  const bool active = ImGui::IsItemActive();
  describe_item(ui, info);
  ValidatedText& validated = ui.validated_text;
  if (validated.parameter != info.name || validated.text != text)
    validated = {info.name, text, text == current ? Result<void>() : info.validate_text(text)};
  const Result<void> accepted = text == current ? Result<void>() : validated.result;
  if (entered && accepted) edit.value = text;
  if (entered && !accepted) state.notices.add_error(info.label + ": " + accepted.error().message);
  ImGui::SameLine(0, 0);
  options_combo(ui, info, nullptr, index_of_option(info), edit);
  if (active && !accepted) warning(ui, accepted.error().message);
  ImGui::EndGroup();
  return edit;
}

WidgetEdit toggle_widget(UiContext& ui, const ParameterInfo& info) {
  WidgetEdit edit;
  bool on = std::get<bool>(info.default_value);
  if (ImGui::Checkbox("##", &on)) edit.value = on;
  describe_item(ui, info);
  return edit;
}

// `stored` describes the value in the document, which the context menu copies and resets.
WidgetEdit any_widget(AppState& state, const ParameterInfo& info, const ParameterInfo& stored) {
  WidgetEdit edit;
  ImGui::PushID(info.name.c_str());
  const OptionWidths widths = widths_of_options(state.ui, info);
  const float room = parameter_label(state.ui, info.name, info.label, widths.current);
  state.ui.items.add_text(info.name, room >= widths.largest);
  switch (info.type) {
    case ParameterType::toggle:
      edit = toggle_widget(state.ui, info);
      break;
    case ParameterType::choice:
      edit = info.validate_text ? text_widget(state, info) : choice_widget(state.ui, info);
      break;
    case ParameterType::integer:
    case ParameterType::number:
      edit = number_field(state, info);
      break;
  }
  if (parameter_menu(state, stored)) edit.reset = true;
  ImGui::PopID();
  if (!edit.value) {
    edit.value = take_requested_value(state.ui, info);
    edit.scripted = edit.value.has_value();
  }
  return edit;
}

WidgetEdit any_widget(AppState& state, const ParameterInfo& info) { return any_widget(state, info, info); }

// A parameter without effect: its widget is disabled, and the tooltip says why.
void disabled_widget(AppState& state, const render::DocumentParameter& parameter) {
  const ParameterInfo& info = parameter.info;
  if (state.ui.items.take_request(info.name)) state.ui.items.answer(info.name + ": " + parameter.inactive_reason);
  ParameterInfo explained = info;
  explained.doc += "\nNot available: " + parameter.inactive_reason;
  ImGui::BeginDisabled();
  any_widget(state, explained);
  ImGui::EndDisabled();
}

void document_widget(AppState& state, const render::DocumentParameter& parameter) {
  if (!parameter.inactive_reason.empty()) return disabled_widget(state, parameter);
  const WidgetEdit edit = any_widget(state, parameter.info);
  apply_edit(state, parameter, edit);
  const ParameterType type = parameter.info.type;
  const bool single_step = type == ParameterType::toggle || type == ParameterType::choice;
  if (single_step && edit.value) state.editor->end_gesture();
}

// The name of a parameter without its last two characters, such as ".r".
std::string stem_of(const std::string& name) { return name.substr(0, name.size() - 2); }

// The number of parameters from index i on whose names differ only in the endings, if all endings of a known set are
// there: 3 for a colour or a vector, 4 for a quaternion, otherwise 0.
size_t length_of_group(const Parameters& list, size_t i, std::span<const char* const> endings) {
  const std::string stem = stem_of(list[i].info.name);
  size_t n = 0;
  while (n < endings.size() && i + n < list.size() && list[i + n].info.name == stem + endings[n]) ++n;
  return n >= 3 ? n : 0;
}

// Whether the filter of the panel shows a parameter. Scripts reach all parameters.
bool passes_filter(const UiContext& ui, const ParameterInfo& info) {
  if (ui.filter.empty() || ui.items.is_requested(info.name) || ui.items.pointed_out() == info.name) return true;
  return lower_case(info.label + " " + info.name + " " + info.doc).find(ui.filter) != std::string::npos;
}

template <class Predicate>
void widgets_if(AppState& state, const std::string& section, Predicate is_shown) {
  constexpr const char* kColorEndings[] = {".r", ".g", ".b"};
  constexpr const char* kVectorEndings[] = {".x", ".y", ".z", ".w"};
  const Parameters list = render::section_parameters(state.document(), section);
  for (size_t i = 0; i < list.size(); ++i) {
    if (!is_shown(list[i].info.name.substr(section.size() + 1))) continue;
    const size_t color_length = length_of_group(list, i, kColorEndings);
    const size_t vector_length = length_of_group(list, i, kVectorEndings);
    const size_t length = std::max(color_length, vector_length);
    const auto parameters = std::span(list).subspan(i, std::max<size_t>(1, length));
    const auto passes = [&](const auto& parameter) { return passes_filter(state.ui, parameter.info); };
    if (std::ranges::none_of(parameters, passes)) {
      i += parameters.size() - 1;
      continue;
    }
    if (color_length == 3)
      color_widget(state, parameters);
    else if (vector_length == 3)
      vector_widget(state, parameters);
    else if (vector_length == 4)
      rotation_widget(state, parameters);
    else
      document_widget(state, list[i]);
    i += parameters.size() - 1;
  }
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// The value of a parameter that is not part of the document after an edit; nothing if it stays.
std::optional<Value> new_value(const AppState& state, const ParameterInfo& info, const WidgetEdit& edit) {
  if (!edit.reset) return edit.value;
  auto value = reset_value(state, info.name);
  return value != info.default_value ? value : std::nullopt;
}

}  // namespace

void section_widgets(AppState& state, const std::string& section) {
  widgets_if(state, section, [](const std::string&) { return true; });
}

void section_widgets_for(AppState& state, const std::string& section, const std::vector<std::string>& names) {
  widgets_if(state, section, [&](const std::string& name) { return contains(names, name); });
}

void section_widgets_except(AppState& state, const std::string& section, const std::vector<std::string>& names) {
  widgets_if(state, section, [&](const std::string& name) { return !contains(names, name); });
}

void scaled_widget(AppState& state, const std::string& name, const UnitScale& scale) {
  for (const auto& parameter : render::section_parameters(state.document(), name.substr(0, name.rfind('.')))) {
    if (parameter.info.name != name || !passes_filter(state.ui, parameter.info)) continue;
    render::DocumentParameter shown = parameter;
    shown.info.unit = scale.unit;
    shown.info.default_value = std::get<double>(parameter.info.default_value) * scale.factor;
    shown.info.min *= scale.factor;
    shown.info.max *= scale.factor;
    shown.assign = [assign = parameter.assign, factor = scale.factor](render::Document& d, const Value& v) {
      assign(d, std::get<double>(v) / factor);
    };
    const WidgetEdit edit = any_widget(state, shown.info, parameter.info);
    apply_edit(state, edit.reset ? parameter : shown, edit);
  }
}

std::optional<Value> parameter_widget(AppState& state, const ParameterInfo& info) {
  if (!passes_filter(state.ui, info)) return std::nullopt;
  return new_value(state, info, any_widget(state, info));
}

std::optional<Value> compact_choice(AppState& state, const ParameterInfo& info, float width) {
  WidgetEdit edit;
  const size_t selected = index_of_option(info);
  ImGui::PushID(info.name.c_str());
  ImGui::SetNextItemWidth(width);
  const bool open = begin_combo("##", info.option_labels[selected].c_str());
  if (open) {
    edit.value = option_list(state.ui, info, selected);
    ImGui::EndCombo();
  } else {
    state.ui.items.add_text(info.name, std::round(ImGui::GetItemRectSize().x) >= width_of_choice(state.ui, info));
    describe_choice(state.ui, info, info.option_labels[selected]);
    edit.reset = parameter_menu(state, info);
  }
  ImGui::PopID();
  const std::optional<Value> value = new_value(state, info, edit);
  return value ? value : take_requested_value(state.ui, info);
}

float width_of_choice(const UiContext& ui, const ParameterInfo& info) { return widths_of_options(ui, info).largest; }

std::optional<Value> compact_toggle(AppState& state, const ParameterInfo& info) {
  ImGui::PushID(info.name.c_str());
  WidgetEdit edit = toggle_widget(state.ui, info);
  edit.reset = parameter_menu(state, info);
  ImGui::PopID();
  ImGui::SameLine();
  ImGui::TextUnformatted(info.label.c_str());
  const std::optional<Value> value = new_value(state, info, edit);
  return value ? value : take_requested_value(state.ui, info);
}

std::optional<Value> compact_number(AppState& state, const ParameterInfo& info, float width) {
  const auto* integer = std::get_if<int64_t>(&info.default_value);
  const double value = integer ? static_cast<double>(*integer) : std::get<double>(info.default_value);
  ImGui::PushID(info.name.c_str());
  ImGui::SetNextItemWidth(width);
  WidgetEdit edit = number_field(state, info, std::max(0.02f, 0.01f * static_cast<float>(value)));
  if (parameter_menu(state, info)) edit.reset = true;
  ImGui::PopID();
  return new_value(state, info, edit);
}

}  // namespace etendue::viewer
