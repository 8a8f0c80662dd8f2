// One setting as a field: drawn, described, heard by scripts, put into the document.
#pragma once
#include <span>

#include "viewer/state/app_state.h"
#include "viewer/widgets/number_widget.h"

namespace etendue::viewer {

// What a hand or a script did to a field.
struct Change {
  std::optional<Value> value;
  bool reset = false, forget = false, ended = false;
};

// What a script asks for goes the same way as what a hand enters.
std::optional<Value> from_script(Workbench& w, const ParameterInfo& info);
// Names the item that was drawn last, and says what it is while the pointer rests on it.
void describe_field(Workbench& w, const ParameterInfo& info);
// A number in the width that was set; `drag` as in number_widget.
Change number_field(Workbench& w, const ParameterInfo& info, float drag = 0);
// Makes the change an edit, a reset, or the end of a gesture.
void commit(Workbench& w, const render::DocumentParameter& binding, const Change& change);

// The options of a choice in an open list, integrators under the names of their groups; the one that was chosen.
std::optional<Value> option_list(const Workbench& w, const ParameterInfo& info, size_t index);

// The value that the opened file had.
std::optional<Value> original(const Workbench& w, const std::string& name);

// Three fields in one line: NAME.x, NAME.y, NAME.z.
void vector_row(Workbench& w, std::span<const render::DocumentParameter> xyz);
// The quaternion NAME.x .. NAME.w as three angles in degrees, which scripts know as SECTION.euler.x, .y and .z.
void rotation_row(Workbench& w, std::span<const render::DocumentParameter> xyzw);
// The settings of a rotation row, as scripts see them.
std::vector<ParameterInfo> euler_parameters(const std::string& section, const Vec3& degrees);

}  // namespace etendue::viewer
