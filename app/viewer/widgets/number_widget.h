// A widget for one number: a slider if the range is narrow enough, otherwise a drag field.
//
// A double click opens text input. Ctrl+click resets.
#pragma once
#include <optional>
#include <string>

#include "base/parameter.h"

namespace etendue::viewer {

// What the user did in this frame.
struct WidgetEdit {
  std::optional<Value> value;  // if it was changed
  bool reset = false;          // Ctrl+click
  bool pressed = false;        // a click that is not the second one of a double click
  bool starts_typing = false;  // double click
  bool ended = false;          // the drag or the text input has ended
  bool scripted = false;       // the value comes from a script
};

// `info.default_value` is the current value. A positive `drag_speed`, in units per pixel, makes it a drag field.
WidgetEdit number_widget(const ParameterInfo& info, float drag_speed = 0);
// The value as the widget shows it: "39.6 °".
std::string number_label(const ParameterInfo& info);
// The range as the user sees it: "0 to 180 °".
std::string range_text(const ParameterInfo& info);

// The width of the column of labels. The widgets fill the rest of the line.
float label_width();
// Places the next item beside a label, at the end of the column of labels or, after a longer label, of its text.
void continue_after_label(float text_width);
// Draws a label. The next item fills the rest of the line, or the next line if the label or `least_width` leaves no room
// for the other. Returns the largest `least_width` that an item can have; 0 if the label is cut.
float label_column(const std::string& label, float least_width = 0);

}  // namespace etendue::viewer
