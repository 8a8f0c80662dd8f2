// Vectors and rotations: three fields in one line.
#include <imgui.h>

#include "scene/rotation.h"
#include "viewer/widgets/parameter_field.h"

namespace etendue::viewer {
namespace {

constexpr const char* kAxes[3] = {"x", "y", "z"};

std::string stem(const std::string& name) { return name.substr(0, name.size() - 2); }

// A thousandth of what there is for each pixel that the hand moves, so that a drag suits dolls' houses and cities.
float metres_per_pixel(const Workbench& w) {
  const auto scene = w.session.scene();
  const Bounds bounds = scene ? scene->bounds() : Bounds{};
  const float extent = bounds.empty() ? 1 : glm::length(bounds.max - bounds.min);
  return std::clamp(0.001f * extent, 1e-6f, 1e4f);
}

// Each field stands alone; `field(axis)` draws it.
template <class Field>
void row(const std::string& label, Field field) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x * 0.75f;
  label_column(label);
  const float width = std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(width);
    ImGui::PushID(axis);
    field(axis);
    ImGui::PopID();
  }
}

void edit_rotation(Workbench& w, std::span<const render::DocumentParameter> xyzw, const Vec4& rotation,
                   const char* gesture) {
  const Value values[4] = {double{rotation.x}, double{rotation.y}, double{rotation.z}, double{rotation.w}};
  w.edit(xyzw, values, gesture);
}

Vec4 quaternion_of(std::span<const render::DocumentParameter> xyzw) {
  Vec4 q;
  for (int c = 0; c < 4; ++c)
    q[c] = static_cast<float>(std::get<double>(xyzw[static_cast<size_t>(c)].info.default_value));
  return q;
}

// The rotation that the file had.
std::optional<Vec4> original_rotation(const Workbench& w, std::span<const render::DocumentParameter> xyzw) {
  Vec4 q;
  for (int c = 0; c < 4; ++c) {
    const auto value = original(w, xyzw[static_cast<size_t>(c)].info.name);
    if (!value) return std::nullopt;
    q[c] = static_cast<float>(std::get<double>(*value));
  }
  return q;
}

}  // namespace

void vector_row(Workbench& w, std::span<const render::DocumentParameter> xyz) {
  const ParameterInfo& first = xyz[0].info;
  const bool metres = first.unit == "m";
  ImGui::PushID(first.name.c_str());
  row(metres ? first.label + " (m)" : first.label, [&](int axis) {
    const render::DocumentParameter& binding = xyz[static_cast<size_t>(axis)];
    ParameterInfo info = binding.info;
    info.unit.clear();  // the label has it
    commit(w, binding, number_field(w, info, metres ? metres_per_pixel(w) : 0.005f));
  });
  ImGui::PopID();
}

std::vector<ParameterInfo> euler_parameters(const std::string& section, const Vec3& degrees) {
  std::vector<ParameterInfo> list(3);
  for (int axis = 0; axis < 3; ++axis) {
    auto& info = list[static_cast<size_t>(axis)];
    info.name = section + ".euler." + kAxes[axis];
    info.label = "Rotation", info.unit = "\u00b0", info.min = -360, info.max = 360;
    info.doc = std::string("Degrees about the parent's ") + kAxes[axis] + " axis; x turns first, then y, then z";
    info.default_value = static_cast<double>(degrees[axis]);
  }
  return list;
}

void rotation_row(Workbench& w, std::span<const render::DocumentParameter> xyzw) {
  const std::string name = stem(xyzw[0].info.name), section = xyzw[0].section;
  const Vec4 now = quaternion_of(xyzw);
  // Angles stay as the hand left them: 120 degrees about y would come back as 60 and two half turns.
  if (w.turned.name != name || w.turned.rotation != now) w.turned = {name, now, scene::euler_degrees(now)};
  const auto infos = euler_parameters(section, w.turned.degrees);
  ImGui::PushID(name.c_str());
  row("Rotation (\u00b0)", [&](int axis) {
    ParameterInfo info = infos[static_cast<size_t>(axis)];
    info.unit.clear();
    const Change change = number_field(w, info, 0.5f);
    if (change.forget) w.editor.forget(name);
    if (change.reset) {
      if (const auto before = original_rotation(w, xyzw); before && *before != now) edit_rotation(w, xyzw, *before, "");
    } else if (change.value && *change.value != info.default_value) {
      Vec3 degrees = w.turned.degrees;
      degrees[axis] = static_cast<float>(std::get<double>(*change.value));
      const Vec4 turned = scene::rotation_of(degrees);
      w.turned = {name, turned, degrees};
      edit_rotation(w, xyzw, turned, name.c_str());
    }
    if (change.ended) w.editor.end_gesture();
  });
  ImGui::PopID();
  for (const auto& binding : xyzw) {
    w.items.place(binding.info.name);
    if (const auto value = from_script(w, binding.info)) w.edit(binding, *value);
  }
}

}  // namespace etendue::viewer
