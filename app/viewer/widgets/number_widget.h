// One number: a slider where the range says something, a field to drag in where it is only a limit.
#pragma once
#include <optional>
#include <string>

#include "base/parameter.h"

namespace etendue::viewer {

struct NumberEdit {
  std::optional<Value> value;
  bool reset = false;          // Ctrl+click
  bool starts_typing = false;  // double click
  bool ended = false;          // the hand let go
};

// `info.default_value` is the value now. `drag` makes it a field to drag in that moves by so much a pixel.
NumberEdit number_widget(const ParameterInfo& info, float drag = 0);
// What may be entered, as the user sees it: "0 to 180 °".
std::string range_text(const ParameterInfo& info);

// Labels stand in a column of this width, widgets fill the rest of the line.
float label_width();
void label_column(const std::string& label);

}  // namespace etendue::viewer
