// Loads the plugin for OpenVDB files on first use.
#pragma once
#include <filesystem>
#include <vector>

#include "medium/grid_plugin_interface.h"

namespace etendue {

// The plugin; an error says what is missing, to be put after the name of a file.
Result<const GridPlugin*> grid_plugin();

// The same from the first of these folders that has it.
Result<const GridPlugin*> load_grid_plugin(const std::vector<std::filesystem::path>& folders);

}  // namespace etendue
