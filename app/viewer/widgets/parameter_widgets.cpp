#include "viewer/widgets/parameter_widgets.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "integrator/integrator.h"
#include "render/aov.h"
#include "viewer/widgets/parameter_field.h"

namespace etendue::viewer {
namespace {

bool ends_with_channel(const std::string& name) {
  return name.ends_with(".r") || name.ends_with(".g") || name.ends_with(".b");
}

std::string stem_of(const std::string& name) { return name.substr(0, name.size() - 2); }

// The part of a list that an option stands in, and what it is: of methods and reflection models, which are many.
struct Explained {
  const char *heading = nullptr, *heading_doc = "", *doc = "";
};
Explained explained(const ParameterInfo& info, const std::string& option) {
  if (info.name.ends_with("integrator"))
    if (const auto* method = integrator::find_integrator(option)) {
      const auto& group = integrator::info_of(method->group);
      return {group.label, group.doc, method->summary.c_str()};
    }
  if (info.name.ends_with(".model"))
    if (const auto* model = find_bsdf_model(option))
      return {Options<ModelClass>::kOptions[static_cast<size_t>(model->description.kind)].label, "",
              model->description.doc};
  return {};
}

void heading_of(const Workbench& w, const Explained& option) {
  ImGui::TextColored(w.theme.quiet, "%s", option.heading);
  if (*option.heading_doc && ImGui::IsItemHovered()) tooltip(w, option.heading_doc);
}

// What is offered, as a list that opens at a button if `shown` is null.
void offered(Workbench& w, const ParameterInfo& info, const char* shown, size_t index, Change& change) {
  const ImGuiComboFlags flags =
      (shown ? 0 : ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft) | ImGuiComboFlags_HeightLarge;
  if (!ImGui::BeginCombo("##offered", shown, flags)) return;
  if (auto chosen = option_list(w, info, index)) change.value = std::move(chosen);
  ImGui::EndCombo();
}

// A field for a text of one's own with the offered ones beside it; what is wrong with a text is said while it is typed.
void text_field(Workbench& w, const ParameterInfo& info, size_t index, Change& change) {
  const auto& now = std::get<std::string>(info.default_value);
  std::string typed = now;  // as long as the field has the keyboard, ImGui has the text
  const float button = ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - button);
  ImGui::PushFont(w.faces.figures);
  const std::string hint = info.option_labels.empty() ? "" : info.option_labels.front();
  const bool entered = ImGui::InputTextWithHint("##text", hint.c_str(), &typed, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopFont();
  const bool active = ImGui::IsItemActive();
  describe_field(w, info);
  if (w.checked.field != info.name || w.checked.text != typed)
    w.checked = {info.name, typed, typed == now ? Result<void>() : info.accepts_text(typed)};
  const Result<void> accepted = typed == now ? Result<void>() : w.checked.answer;
  if (entered && accepted) change.value = typed;
  if (entered && !accepted) w.notices.complain(info.label + ": " + accepted.error().message);
  ImGui::SameLine(0, 0);
  offered(w, info, nullptr, index, change);
  if (!active || accepted) return;
  warning(w, accepted.error().message);
}

Change one_widget(Workbench& w, const ParameterInfo& info) {
  Change change;
  ImGui::PushID(info.name.c_str());
  label_column(info.label);
  switch (info.type) {
    case ParameterType::toggle: {
      bool on = std::get<bool>(info.default_value);
      if (ImGui::Checkbox("##", &on)) change.value = on;
      break;
    }
    case ParameterType::choice: {
      const std::string& now = std::get<std::string>(info.default_value);
      const auto at = std::find(info.options.begin(), info.options.end(), now);
      const size_t index = static_cast<size_t>(at - info.options.begin());
      if (info.accepts_text) {
        text_field(w, info, index, change);
        ImGui::PopID();
        if (!change.value) change.value = from_script(w, info);
        return change;
      }
      offered(w, info, index < info.options.size() ? info.option_labels[index].c_str() : now.c_str(), index, change);
      break;
    }
    case ParameterType::integer:
    case ParameterType::number:
      change = number_field(w, info);
      ImGui::PopID();
      return change;
  }
  describe_field(w, info);
  ImGui::PopID();
  if (!change.value) change.value = from_script(w, info);
  return change;
}

// It can be read, and says why it cannot be turned.
void idle_widget(Workbench& w, const render::DocumentParameter& binding) {
  if (w.items.take(binding.info.name)) w.items.answer(binding.info.name + ": " + binding.idle);
  ParameterInfo info = binding.info;
  info.doc += "\nNot now: " + binding.idle;
  ImGui::BeginDisabled();
  one_widget(w, info);
  ImGui::EndDisabled();
}

void binding_widget(Workbench& w, const render::DocumentParameter& binding) {
  if (!binding.idle.empty()) return idle_widget(w, binding);
  const Change change = one_widget(w, binding.info);
  commit(w, binding, change);
  const bool at_once = binding.info.type == ParameterType::toggle || binding.info.type == ParameterType::choice;
  if (at_once && change.value) w.editor.end_gesture();
}

// Three bindings in one: a swatch and three figures.
void color_widget(Workbench& w, std::span<const render::DocumentParameter> rgb) {
  const std::string stem = stem_of(rgb[0].info.name);
  float now[3];
  for (size_t c = 0; c < 3; ++c) now[c] = static_cast<float>(std::get<double>(rgb[c].info.default_value));
  ImGui::PushID(stem.c_str());
  label_column(rgb[0].info.label);
  ImGui::PushFont(w.faces.figures);
  ImGuiColorEditFlags flags = ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_NoTooltip;
  if (rgb[0].info.max > 1) flags |= ImGuiColorEditFlags_HDR;
  const bool control_click = ImGui::GetIO().KeyCtrl && ImGui::IsMouseClicked(0) &&
                             ImGui::IsMouseHoveringRect(ImGui::GetCursorScreenPos(),
                                                        {ImGui::GetCursorScreenPos().x + ImGui::CalcItemWidth(),
                                                         ImGui::GetCursorScreenPos().y + ImGui::GetFrameHeight()});
  const bool edited = !control_click && ImGui::ColorEdit3("##", now, flags);
  if (control_click)
    ImGui::ColorButton("##", {now[0], now[1], now[2], 1}, flags, {ImGui::CalcItemWidth(), ImGui::GetFrameHeight()});
  const bool ended = ImGui::IsItemDeactivatedAfterEdit();
  ImGui::PopFont();
  ParameterInfo shown = rgb[0].info;
  shown.name = stem;
  describe_field(w, shown);
  bool scripted = false;
  for (size_t c = 0; c < 3; ++c) {
    w.items.place(rgb[c].info.name);
    if (const auto value = from_script(w, rgb[c].info))
      now[c] = static_cast<float>(std::get<double>(*value)), scripted = true;
    if (const auto before = control_click ? original(w, rgb[c].info.name) : std::nullopt)
      now[c] = static_cast<float>(std::get<double>(*before));
  }
  if (edited || scripted || control_click) {
    Value values[3];
    bool differs = false;
    for (size_t c = 0; c < 3; ++c) {
      values[c] = std::clamp(static_cast<double>(now[c]), rgb[c].info.min, rgb[c].info.max);
      differs = differs || values[c] != rgb[c].info.default_value;
    }
    if (differs) w.edit(rgb, values, stem);
  }
  if (ended || scripted || control_click) w.editor.end_gesture();
  ImGui::PopID();
}

bool names_color(const std::vector<render::DocumentParameter>& list, size_t i) {
  return i + 2 < list.size() && ends_with_channel(list[i].info.name) && list[i].info.name.ends_with(".r") &&
         stem_of(list[i + 2].info.name) == stem_of(list[i].info.name);
}

// How many settings from here on make a vector (3), a quaternion (4), or neither (0).
size_t vector_length(const std::vector<render::DocumentParameter>& list, size_t i) {
  constexpr const char* kEnds[4] = {".x", ".y", ".z", ".w"};
  const std::string stem = stem_of(list[i].info.name);
  size_t n = 0;
  while (n < 4 && i + n < list.size() && list[i + n].info.name == stem + kEnds[n]) ++n;
  return n >= 3 ? n : 0;
}

template <class Wanted>
void widgets(Workbench& w, const std::string& section, Wanted wanted) {
  const auto list = render::bindings(w.editor.document(), section);
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string bare = list[i].info.name.substr(section.size() + 1);
    if (!wanted(bare)) continue;
    if (names_color(list, i)) {
      color_widget(w, std::span(list).subspan(i, 3));
      i += 2;
    } else if (const size_t length = vector_length(list, i)) {
      const auto parts = std::span(list).subspan(i, length);
      length == 4 ? rotation_row(w, parts) : vector_row(w, parts);
      i += length - 1;
    } else {
      binding_widget(w, list[i]);
    }
  }
}

}  // namespace

std::optional<Value> option_list(const Workbench& w, const ParameterInfo& info, size_t index) {
  std::optional<Value> chosen;
  const char* heading = nullptr;
  for (size_t i = 0; i < info.options.size(); ++i) {
    const Explained option = explained(info, info.options[i]);
    if (option.heading && std::exchange(heading, option.heading) != option.heading) heading_of(w, option);
    const float inset = option.heading ? ImGui::GetFontSize() * 0.6f : 0;
    if (option.heading) ImGui::Indent(inset);
    if (ImGui::Selectable(info.option_labels[i].c_str(), i == index)) chosen = info.options[i];
    if (*option.doc && ImGui::IsItemHovered()) tooltip(w, option.doc);
    if (option.heading) ImGui::Unindent(inset);
  }
  return chosen;
}

void section_widgets(Workbench& w, const std::string& section) {
  widgets(w, section, [](const std::string&) { return true; });
}

void some_widgets(Workbench& w, const std::string& section, const std::vector<std::string>& names) {
  widgets(w, section,
          [&](const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); });
}

void other_widgets(Workbench& w, const std::string& section, const std::vector<std::string>& names) {
  widgets(w, section,
          [&](const std::string& name) { return std::find(names.begin(), names.end(), name) == names.end(); });
}

std::optional<Value> loose_widget(Workbench& w, const ParameterInfo& info) { return one_widget(w, info).value; }

std::vector<ParameterInfo> loose_parameters() {
  ParameterInfo false_color;
  false_color.name = "view.false-color", false_color.label = "False colour";
  false_color.doc = "Luminance on a logarithmic scale, in colours that can be read without colour vision";
  false_color.type = ParameterType::toggle;
  ParameterInfo layer;
  layer.name = "view.aov", layer.label = "Layer";
  layer.doc = "What lies under the pixels instead of the picture; the rendering goes on";
  layer.type = ParameterType::choice;
  layer.options = {"picture"}, layer.option_labels = {"Picture"};
  for (std::string name : layer_names()) {
    layer.options.push_back(name);
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    std::replace(name.begin(), name.end(), '-', ' ');
    layer.option_labels.push_back(name);
  }
  layer.default_value = std::string("picture");
  return {false_color, layer};
}

void tooltip(const Workbench& w, const std::string& text) {
  if (w.pointer_rest < kTooltipDelay) return;
  ImGui::PushFont(w.faces.text);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopFont();
}

void action_button(Workbench& w, const char* name) {
  const Action* action = w.actions.find(name);
  ImGui::BeginDisabled(!action->is_enabled());
  const bool on = action->checked && action->checked();
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
  if (ImGui::Button(action->label.c_str())) action->run();
  if (on) ImGui::PopStyleColor();
  ImGui::EndDisabled();
  w.items.place(name);
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  std::string keys;
  for (const Chord& chord : action->chords()) keys += "  " + label(chord);
  tooltip(w, action->doc + keys);
}

void note(const Workbench& w, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, w.theme.quiet);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void warning(const Workbench& w, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, w.theme.warning);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void figure(const Workbench& w, const char* name, const std::string& value) {
  ImGui::TextDisabled("%s", name);
  // A long name pushes its figure to the right rather than lie under it.
  const float end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetFontSize() * 0.4f;
  ImGui::SameLine(std::max(label_width(), end));
  ImGui::PushFont(w.faces.figures);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopFont();
}

bool group(Workbench& w, const char* name, const std::string& prefix, bool open) {
  if (!prefix.empty() && w.items.wanted_below(prefix)) ImGui::SetNextItemOpen(true);
  ImGui::Spacing();
  // Quieter than a selected row.
  ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
  const bool shown = ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  ImGui::PopStyleColor();
  return shown;
}

}  // namespace etendue::viewer
