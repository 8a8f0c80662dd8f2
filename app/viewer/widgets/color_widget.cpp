#include "viewer/widgets/color_widget.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "render/document.h"
#include "spectrum/blackbody.h"
#include "spectrum/rgb.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/srgb.h"
#include "viewer/widgets/parameter_field.h"
#include "viewer/widgets/vector_widgets.h"

namespace etendue::viewer {
namespace {

constexpr double kMinStrength = -16, kMaxStrength = 16;  // EV

using ColorParameters = std::span<const render::DocumentParameter>;

// The name without ".r".
std::string name_of(ColorParameters rgb) { return rgb[0].info.name.substr(0, rgb[0].info.name.size() - 2); }

Rgb value_of(ColorParameters rgb) {
  Rgb color;
  for (int c = 0; c < 3; ++c)
    color[c] = static_cast<float>(std::get<double>(rgb[static_cast<size_t>(c)].info.default_value));
  return color;
}

void set_color(AppState& state, ColorParameters rgb, const Rgb& color) {
  Value values[3];
  bool differs = false;
  for (size_t c = 0; c < 3; ++c) {
    values[c] = std::clamp(static_cast<double>(color[static_cast<int>(c)]), rgb[c].info.min, rgb[c].info.max);
    differs = differs || values[c] != rgb[c].info.default_value;
  }
  if (differs) state.edit(rgb, values, name_of(rgb));
}

// The tooltip and the item of the whole colour. `hint` says what a click does.
void describe_color(AppState& state, ColorParameters rgb, const std::function<std::string()>& hint) {
  ParameterInfo info = rgb[0].info;
  info.name = name_of(rgb);
  describe_item(state.ui, info, hint);
}

// The colour with the components that a script requests, if it does.
std::optional<Rgb> requested_color(AppState& state, ColorParameters rgb) {
  Rgb color = value_of(rgb);
  bool requested = false;
  for (size_t c = 0; c < 3; ++c) {
    state.ui.items.add(rgb[c].info.name);
    if (const auto value = take_requested_value(state.ui, rgb[c].info)) {
      color[static_cast<int>(c)] = static_cast<float>(std::get<double>(*value));
      requested = true;
    }
  }
  return requested ? std::optional(color) : std::nullopt;
}

// The colour of the opened file.
Rgb original_color(const AppState& state, ColorParameters rgb) {
  Rgb color = value_of(rgb);
  for (size_t c = 0; c < 3; ++c)
    if (const auto original = original_value(state, rgb[c].info.name))
      color[static_cast<int>(c)] = static_cast<float>(std::get<double>(*original));
  return color;
}

// The context menu of the last item.
bool color_menu(AppState& state, ColorParameters rgb) {
  const std::string hex = srgb_hex(value_of(rgb));
  return parameters_menu(state, rgb, "Copy " + hex + " (sRGB)", hex);
}

void factor_widget(AppState& state, ColorParameters rgb) {
  constexpr ImGuiColorEditFlags kFlags = ImGuiColorEditFlags_DisplayHex | ImGuiColorEditFlags_NoLabel |
                                         ImGuiColorEditFlags_NoTooltip |
                                         ImGuiColorEditFlags_NoOptions;  // the context menu is our own
  Rgb shown = srgb_of_linear(value_of(rgb));
  ImGui::PushID(name_of(rgb).c_str());
  parameter_label(state.ui, name_of(rgb), rgb[0].info.label);
  ImGui::PushFont(state.ui.fonts.monospace);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::CalcItemWidth(), ImGui::GetFrameHeight()};
  const bool hovered = ImGui::IsMouseHoveringRect(corner, {corner.x + size.x, corner.y + size.y});
  const bool reset = hovered && ImGui::GetIO().KeyCtrl && ImGui::IsMouseClicked(0);
  bool edited = false;
  // ColorEdit3 would open text input on Ctrl+click.
  if (reset)
    ImGui::ColorButton("##", {shown.r, shown.g, shown.b, 1}, kFlags, size);
  else
    edited = ImGui::ColorEdit3("##", &shown.r, kFlags);
  const bool ended = ImGui::IsItemDeactivatedAfterEdit();
  ImGui::PopFont();
  describe_color(state, rgb, [&] {
    const bool can_be_reset = original_value(state, rgb[0].info.name).has_value();
    return std::string("Click: enter a hexadecimal sRGB value") + (can_be_reset ? ". Ctrl+click: reset" : "");
  });
  const bool reset_by_menu = color_menu(state, rgb);
  const std::optional<Rgb> requested = requested_color(state, rgb);
  if (requested) state.editor->end_gesture();
  if (reset_by_menu)
    reset_parameters(state, rgb);
  else if (reset)
    set_color(state, rgb, original_color(state, rgb));
  else if (requested)
    set_color(state, rgb, *requested);
  else if (edited)
    set_color(state, rgb, linear_from_srgb(shown));
  if (ended || requested || reset) state.editor->end_gesture();
  ImGui::PopID();
}

// A swatch of the colour, relative to its largest component if that is above one; a click opens a picker, which keeps
// this component.
void radiance_swatch(AppState& state, ColorParameters rgb) {
  const Rgb color = value_of(rgb);
  const float scale = std::max(max_component(color), 1.0f);
  Rgb shown = srgb_of_linear(color / scale);
  const float size = ImGui::GetFrameHeight();
  if (ImGui::ColorButton("##swatch", {shown.r, shown.g, shown.b, 1}, ImGuiColorEditFlags_NoTooltip, {size, size}))
    ImGui::OpenPopup("##picker");
  describe_color(state, rgb, [] { return std::string("Click: choose a colour"); });
  if (color_menu(state, rgb)) reset_parameters(state, rgb);
  if (!ImGui::BeginPopup("##picker")) return;
  if (ImGui::ColorPicker3("##color", &shown.r, ImGuiColorEditFlags_DisplayHex))
    set_color(state, rgb, linear_from_srgb(shown) * scale);
  state.ui.items.add(name_of(rgb) + ".picker");
  if (ImGui::IsItemDeactivatedAfterEdit()) state.editor->end_gesture();
  ImGui::EndPopup();
}

}  // namespace

namespace {

// NAME.r, NAME.g and NAME.b among the parameters of their section; empty if it does not have them.
ColorParameters color_of(const std::vector<render::DocumentParameter>& list, const std::string& name) {
  const auto first = std::ranges::find_if(list, [&](const auto& p) { return p.info.name == name + ".r"; });
  if (list.end() - first < 3) return {};
  return std::span(list).subspan(static_cast<size_t>(first - list.begin()), 3);
}

std::vector<render::DocumentParameter> section_of(const AppState& state, const std::string& name) {
  return render::section_parameters(state.document(), name.substr(0, name.rfind('.')));
}

// A field for a number that stands for a colour; `color` is the colour of a new value.
void derived_field(AppState& state, const ParameterInfo& info, ColorParameters rgb, const std::string& gesture,
                   const std::function<Rgb(double)>& color) {
  ImGui::PushID(info.name.c_str());
  parameter_label(state.ui, info.name, info.label);
  const WidgetEdit edit = number_field(state, info, 0, rgb[0].info.name);
  const bool reset_by_menu = color_menu(state, rgb);
  ImGui::PopID();
  start_edit(state, info, edit, gesture);
  if (reset_by_menu)
    reset_parameters(state, rgb);
  else if (edit.reset)
    set_color(state, rgb, original_color(state, rgb));
  else if (edit.value && *edit.value != info.default_value)
    set_color(state, rgb, color(std::get<double>(*edit.value)));
  if (edit.ended || edit.scripted || edit.reset) state.editor->end_gesture();
}

}  // namespace

void temperature_widget(AppState& state, const std::string& name, const std::string& item) {
  const auto list = section_of(state, name);
  const ColorParameters rgb = color_of(list, name);
  if (rgb.empty()) return;
  ParameterInfo info;
  info.name = item;
  info.label = "Temperature";
  info.doc =
      "Temperature of the black body whose colour is nearest to this one. Sets the colour; higher temperatures are "
      "bluer";
  info.unit = "K";
  info.min = kMinTemperature;
  info.max = kMaxTemperature;
  info.logarithmic = true;
  // The search takes a fraction of a millisecond, so its result is kept.
  TemperatureCache& cache = state.ui.temperature;
  const Rgb color = value_of(rgb);
  if (cache.color != color) {
    cache.color = color;
    cache.kelvin = nearest_temperature(color);
  }
  info.default_value = std::round(cache.kelvin);
  derived_field(state, info, rgb, name, [&](double kelvin) {
    cache.kelvin = kelvin;
    return cache.color = blackbody_color(kelvin);
  });
}

void strength_widget(AppState& state, const std::string& name, const std::string& item) {
  const auto list = section_of(state, name);
  const ColorParameters rgb = color_of(list, name);
  const Rgb present = rgb.empty() ? Rgb(0) : value_of(rgb);
  const float largest = max_component(present);
  if (!(largest > 0)) return;
  ParameterInfo info;
  info.name = item;
  info.label = "Strength";
  info.doc = "Largest component of the luminance in steps of a factor of two; 0 EV: 1. All three components are scaled";
  info.unit = "EV";
  info.min = kMinStrength;
  info.max = kMaxStrength;
  info.default_value = std::round(1000 * std::log2(static_cast<double>(largest))) / 1000;
  derived_field(state, info, rgb, name,
                [&](double strength) { return present / largest * static_cast<float>(std::exp2(strength)); });
}

void color_widget(AppState& state, ColorParameters rgb) {
  if (rgb[0].info.max <= 1) return factor_widget(state, rgb);
  if (rgb[0].info.unit.empty()) return vector_widget(state, rgb);
  vector_widget(state, rgb, [&] { radiance_swatch(state, rgb); });
}

}  // namespace etendue::viewer
