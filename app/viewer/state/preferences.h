// The settings that the Preferences dialog shows as parameters: "preferences.scale", "preferences.theme", ...
#pragma once
#include <string>
#include <vector>

#include "base/parameter.h"

namespace etendue::viewer {

struct Settings;

// The parameters with their current values, in two sections.
std::vector<ParameterInfo> interface_preferences(const Settings& settings);
std::vector<ParameterInfo> rendering_preferences(const Settings& settings);

// Changes a setting. `name` and `value` are those of a parameter above.
void assign_preference(Settings& settings, const std::string& name, const Value& value);

}  // namespace etendue::viewer
