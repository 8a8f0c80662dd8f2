// Where plugins are: shared libraries that the program loads on first use.
#pragma once
#include <filesystem>
#include <vector>

namespace etendue {

// The folder named by the environment variable ETENDUE_PLUGIN_PATH, or those beside the program.
std::vector<std::filesystem::path> plugin_folders();

}  // namespace etendue
