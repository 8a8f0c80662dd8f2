// Widgets made from descriptions: one kind for each kind of parameter, with label, unit, range and tooltip.
//
// Double click types a number, Ctrl+click resets to what the file had. A drag is one step of undo.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "viewer/state/app_state.h"

namespace etendue::viewer {

// All settings of a section, colours joined: NAME.r, NAME.g, NAME.b are one widget.
void section_widgets(Workbench& w, const std::string& section);
// Those whose names (without the section) are given, or are not.
void some_widgets(Workbench& w, const std::string& section, const std::vector<std::string>& names);
void other_widgets(Workbench& w, const std::string& section, const std::vector<std::string>& names);

// One setting that is no part of a document: the new value, if it was changed.
std::optional<Value> loose_widget(Workbench& w, const ParameterInfo& info);

// A button for an action, with its tooltip.
void action_button(Workbench& w, const char* name);
// A line of quiet words, wrapped.
void note(const Workbench& w, const std::string& text);
// The same of what the user should heed.
void warning(const Workbench& w, const std::string& text);
// A line with a label on the left and a figure in tabular digits.
void figure(const Workbench& w, const char* label, const std::string& value);
// A folding group; it opens itself for a script that wants a widget whose name starts so.
bool group(Workbench& w, const char* label, const std::string& prefix, bool open = true);
// Shown once the pointer has rested for a moment.
void tooltip(const Workbench& w, const std::string& text);
inline constexpr double kTooltipDelay = 0.4;  // seconds

// The settings of the viewer itself that scripts can set: false colour and the layer shown.
std::vector<ParameterInfo> loose_parameters();

}  // namespace etendue::viewer
