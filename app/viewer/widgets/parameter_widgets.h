// Widgets for parameters, made from their descriptions: one kind of widget for each type, with label, unit, range and
// tooltip. A drag is one step of undo.
#pragma once
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/parameter.h"

namespace etendue::viewer {

struct AppState;

// All parameters of a section of the document. NAME.r, .g and .b become one colour widget; NAME.x, .y and .z one line.
void section_widgets(AppState& state, const std::string& section);
// Only these parameters of the section, or all others. Names are without the section.
void section_widgets_for(AppState& state, const std::string& section, const std::vector<std::string>& names);
void section_widgets_except(AppState& state, const std::string& section, const std::vector<std::string>& names);

// A unit in which a number is shown and edited: the stored value times `factor`.
struct UnitScale {
  double factor = 1;
  std::string unit;
};
// A number of the document in another unit. `name` is its qualified name.
void scaled_widget(AppState& state, const std::string& name, const UnitScale& scale);

// A parameter that is not part of the document. Returns the new value if it was changed.
std::optional<Value> parameter_widget(AppState& state, const ParameterInfo& info);

// All parameters of a panel, as a tuple of references.
template <class... P>
void parameter_widgets(AppState& state, const std::tuple<P...>& parameters) {
  for (const ParameterInfo& info : describe_all(parameters))
    if (const auto value = parameter_widget(state, info)) assign_by_name(parameters, info.name, *value);
}

// A choice, a number or a toggle in little space, the first two without a label and of this width in pixels. Returns the
// new value if it was changed. The number is a drag field, because it would not be legible on a slider.
std::optional<Value> compact_choice(AppState& state, const ParameterInfo& info, float width);
std::optional<Value> compact_number(AppState& state, const ParameterInfo& info, float width);
std::optional<Value> compact_toggle(AppState& state, const ParameterInfo& info);
// The width in pixels in which a choice shows each of its options completely.
float width_of_choice(const UiContext& ui, const ParameterInfo& info);

}  // namespace etendue::viewer
