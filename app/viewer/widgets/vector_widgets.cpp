#include "viewer/widgets/vector_widgets.h"

#include <imgui.h>

#include <cmath>

#include "geometry/mesh.h"
#include "render/document.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "scene/rotation.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/parameter_field.h"

namespace etendue::viewer {
namespace {

constexpr const char* kAxes[3] = {"x", "y", "z"};

using Quaternion = std::span<const render::DocumentParameter>;

// A thousandth of the scene's diagonal per pixel, so that a drag suits scenes of any size.
float metres_per_pixel(const AppState& state) {
  const auto scene = state.session->scene();
  const Bounds bounds = scene ? scene->bounds() : Bounds{};
  const float diagonal = bounds.empty() ? 1 : glm::length(bounds.max - bounds.min);
  return std::clamp(0.001f * diagonal, 1e-6f, 1e4f);
}

// A label and three fields, which `draw_field(axis)` draws.
template <class Field>
void three_fields(UiContext& ui, const std::string& name, const std::string& label, Field draw_field,
                  const std::function<void()>& draw_first = {}) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x * 0.75f;
  parameter_label(ui, name, label);
  if (draw_first) {
    draw_first();
    ImGui::SameLine(0, gap);
  }
  const float width = std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(width);
    ImGui::PushID(axis);
    draw_field(axis);
    ImGui::PopID();
  }
}

void edit_rotation(AppState& state, Quaternion parameters, const Vec4& q, const std::string& gesture) {
  const Value values[4] = {double{q.x}, double{q.y}, double{q.z}, double{q.w}};
  state.edit(parameters, values, gesture);
}

Vec4 quaternion_of(Quaternion parameters) {
  Vec4 q;
  for (int c = 0; c < 4; ++c)
    q[c] = static_cast<float>(std::get<double>(parameters[static_cast<size_t>(c)].info.default_value));
  return q;
}

std::optional<Vec4> original_rotation(const AppState& state, Quaternion parameters) {
  Vec4 q;
  for (int c = 0; c < 4; ++c) {
    const auto value = original_value(state, parameters[static_cast<size_t>(c)].info.name);
    if (!value) return std::nullopt;
    q[c] = static_cast<float>(std::get<double>(*value));
  }
  return q;
}

void angle_field(AppState& state, Quaternion parameters, const std::string& gesture, ParameterInfo info, int axis) {
  constexpr float kDegreesPerPixel = 0.5f;
  EnteredRotation& entered = state.ui.entered_rotation;
  info.unit.clear();  // the label has the unit
  const WidgetEdit edit = number_field(state, info, kDegreesPerPixel, parameters[0].info.name);
  if (parameters_menu(state, parameters)) return reset_parameters(state, parameters);
  start_edit(state, info, edit, gesture);
  if (edit.reset) {
    const auto original = original_rotation(state, parameters);
    if (original && *original != quaternion_of(parameters)) edit_rotation(state, parameters, *original, "");
  } else if (edit.value && *edit.value != info.default_value) {
    entered.degrees[axis] = static_cast<float>(std::get<double>(*edit.value));
    entered.quaternion = scene::rotation_of(entered.degrees);
    edit_rotation(state, parameters, entered.quaternion, gesture);
  }
  if (edit.ended) state.editor->end_gesture();
}

}  // namespace

void vector_widget(AppState& state, std::span<const render::DocumentParameter> xyz,
                   const std::function<void()>& draw_first) {
  constexpr float kUnitsPerPixel = 0.005f;
  const ParameterInfo& first = xyz[0].info;
  const bool is_length = first.unit == "m";
  const float speed = is_length ? metres_per_pixel(state) : kUnitsPerPixel;
  ImGui::PushID(first.name.c_str());
  const auto draw_field = [&](int axis) {
    const render::DocumentParameter& parameter = xyz[static_cast<size_t>(axis)];
    ParameterInfo info = parameter.info;
    info.unit.clear();  // the label or the tooltip has the unit
    const WidgetEdit edit = number_field(state, info, speed);
    if (parameters_menu(state, xyz)) return reset_parameters(state, xyz);
    apply_edit(state, parameter, edit);
  };
  three_fields(state.ui, first.name, is_length ? first.label + " (m)" : first.label, draw_field, draw_first);
  ImGui::PopID();
}

std::vector<ParameterInfo> euler_parameters(const std::string& section, const Vec3& degrees) {
  std::vector<ParameterInfo> list(3);
  for (int axis = 0; axis < 3; ++axis) {
    ParameterInfo& info = list[static_cast<size_t>(axis)];
    info.name = section + ".euler." + kAxes[axis];
    info.label = "Rotation";
    info.unit = "\u00b0";
    info.min = -360;
    info.max = 360;
    info.doc = std::string("Rotation about the ") + kAxes[axis] +
               " axis of the parent, in degrees. Rotations are applied in the order x, y, z";
    info.default_value = static_cast<double>(degrees[axis]);
  }
  return list;
}

void rotation_widget(AppState& state, std::span<const render::DocumentParameter> xyzw) {
  const std::string& first = xyzw[0].info.name;
  const std::string name = first.substr(0, first.size() - 2);
  const Vec4 current = quaternion_of(xyzw);
  EnteredRotation& entered = state.ui.entered_rotation;
  if (entered.parameter != name || entered.quaternion != current)
    entered = {.parameter = name, .quaternion = current, .degrees = scene::euler_degrees(current)};
  const auto infos = euler_parameters(xyzw[0].section, entered.degrees);
  ImGui::PushID(name.c_str());
  three_fields(state.ui, name, "Rotation (\u00b0)",
               [&](int axis) { angle_field(state, xyzw, name, infos[static_cast<size_t>(axis)], axis); });
  ImGui::PopID();
  for (const auto& parameter : xyzw) {
    state.ui.items.add(parameter.info.name);
    const auto value = take_requested_value(state.ui, parameter.info);
    if (!value) continue;
    state.editor->end_gesture();
    state.edit(parameter, *value);
  }
}

}  // namespace etendue::viewer
