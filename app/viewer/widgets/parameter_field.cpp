#include "viewer/widgets/parameter_field.h"

#include <imgui.h>

#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {

std::optional<Value> from_script(Workbench& w, const ParameterInfo& info) {
  const auto text = w.items.take(info.name);
  if (!text) return std::nullopt;
  auto value = parse_value(info, *text);
  w.items.answer(value ? "" : value.error().message);
  if (!value) return std::nullopt;
  w.editor.end_gesture();
  return *value;
}

void describe_field(Workbench& w, const ParameterInfo& info) {
  w.items.place(info.name);
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsItemActive()) return;
  std::string text = info.label + ": " + info.doc;
  if (info.type == ParameterType::number || info.type == ParameterType::integer)
    text += "\n" + range_text(info) + "\nDouble click types a number, Ctrl+click resets";
  tooltip(w, text + "\n" + info.name);
}

Change number_field(Workbench& w, const ParameterInfo& info, float drag) {
  ImGui::PushFont(w.faces.figures);
  const NumberEdit edit = number_widget(info, drag);
  ImGui::PopFont();
  describe_field(w, info);
  Change change{edit.value, edit.reset, edit.starts_typing, edit.ended};
  if (!change.value) change.value = from_script(w, info);
  return change;
}

std::optional<Value> original(const Workbench& w, const std::string& name) {
  const auto& origin = w.editor.document().origin;
  if (!origin) return std::nullopt;
  const auto value = render::get(*origin, name);
  return value ? std::optional(*value) : std::nullopt;
}

void commit(Workbench& w, const render::DocumentParameter& binding, const Change& change) {
  // The first click of a double click has moved the slider: that was not meant.
  if (change.forget) w.editor.forget(binding.info.name);
  if (change.reset) {
    const auto value = original(w, binding.info.name);
    if (value && *value != binding.info.default_value) w.edit(binding, *value);
  } else if (change.value && *change.value != binding.info.default_value) {
    w.edit(binding, *change.value, binding.info.name);
  }
  if (change.ended) w.editor.end_gesture();
}

}  // namespace etendue::viewer
