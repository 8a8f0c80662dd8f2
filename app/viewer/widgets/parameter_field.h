// The parts of a parameter widget: reading requests of scripts, the tooltip, and the edit of the document.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "base/parameter.h"
#include "viewer/widgets/number_widget.h"

namespace etendue::render {
struct DocumentParameter;
}

namespace etendue::viewer {

struct AppState;
struct UiContext;

// A value as users see it: numbers with their units, choices by the labels of their options.
std::string value_label(const ParameterInfo& info, const Value& value);

// The value that a script requests for a parameter. Values outside of the range are answered with an error.
std::optional<Value> take_requested_value(UiContext& ui, const ParameterInfo& info);

// The label of the parameter of this name. Widths and result as in label_column.
float parameter_label(UiContext& ui, const std::string& name, const std::string& label, float least_width = 0);

// Registers the last item under the name of the parameter, and shows its tooltip while it is hovered. `hint` says what
// clicks do. It is asked for only while the tooltip is shown, and not if the item is disabled.
void describe_item(UiContext& ui, const ParameterInfo& info, const std::function<std::string()>& hint = {});

// A number widget of the current item width that scripts can set. `drag_speed` as in number_widget. `stored` is the name
// of the parameter that Ctrl+click resets, if the number stands for another one.
WidgetEdit number_field(AppState& state, const ParameterInfo& info, float drag_speed = 0,
                        const std::string& stored = "");

// The options of a choice, to be called in an open combo box. Returns the option that was chosen.
std::optional<Value> option_list(UiContext& ui, const ParameterInfo& info, size_t selected);

// The context menu of the last item: reset, copy. Returns true if the parameter is to be reset. To be called where the ID
// of the parameter is on the stack.
bool parameter_menu(AppState& state, const ParameterInfo& info);

// The same for several parameters that one widget edits: a colour, a vector, a rotation. `label` and `text` are a further
// form of the value that can be copied; none if they are empty.
bool parameters_menu(AppState& state, std::span<const render::DocumentParameter> parameters,
                     const std::string& label = "", const std::string& text = "");

// Sets parameters to the values of the opened file, in one step of undo.
void reset_parameters(AppState& state, std::span<const render::DocumentParameter> parameters);

// To be called before an edit is applied. Discards the step of the first click of a double click, which has moved the
// slider.
void start_edit(AppState& state, const ParameterInfo& info, const WidgetEdit& edit, const std::string& gesture);

// Applies an edit of a widget to the document, and ends the gesture if the drag has ended.
void apply_edit(AppState& state, const render::DocumentParameter& parameter, const WidgetEdit& edit);

// The value of a parameter in the file that was opened; nothing if the document has no such file.
std::optional<Value> original_value(const AppState& state, const std::string& name);

// The value to which a parameter is reset: that of the opened file, or the default of a preference or of a parameter of a
// panel. Nothing if there is none.
std::optional<Value> reset_value(const AppState& state, const std::string& name);

}  // namespace etendue::viewer
