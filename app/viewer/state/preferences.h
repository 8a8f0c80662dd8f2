// The settings that the Preferences dialog shows as parameters: "preferences.scale", "preferences.theme", ...
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/parameter.h"

namespace etendue::viewer {

struct Settings;

// The parameters with their current values, in three sections.
std::vector<ParameterInfo> interface_preferences(const Settings& settings);
std::vector<ParameterInfo> rendering_preferences(const Settings& settings);
// Paths of folders. The label of the only option says what an empty path stands for.
std::vector<ParameterInfo> folder_preferences(const Settings& settings);

// All of them.
std::vector<ParameterInfo> all_preferences(const Settings& settings);
// The value in new settings; nothing if there is no such preference.
std::optional<Value> default_preference(const std::string& name);

// Changes a setting. `name` and `value` are those of a parameter above.
void assign_preference(Settings& settings, const std::string& name, const Value& value);

}  // namespace etendue::viewer
