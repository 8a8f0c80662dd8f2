// The folder for files that can be computed again.
#pragma once
#include <filesystem>

namespace etendue {

// $XDG_CACHE_HOME/etendue or ~/.cache/etendue; empty if neither variable is set.
std::filesystem::path cache_folder();

}  // namespace etendue
