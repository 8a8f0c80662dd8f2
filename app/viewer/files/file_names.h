// Parts of file names.
#pragma once
#include <filesystem>
#include <string>

#include "viewer/widgets/value_text.h"

namespace etendue::viewer {

// The extension of a file in lower case, with its dot.
inline std::string lower_extension(const std::string& file) {
  return lower_case(std::filesystem::path(file).extension().string());
}

// The file name without its folder.
inline std::string base_name(const std::string& file) { return std::filesystem::path(file).filename().string(); }

}  // namespace etendue::viewer
