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

// A file of the folder that does not exist yet: "STEM.exr", or "STEM 2.exr" and so on.
inline std::filesystem::path unused_file(const std::filesystem::path& folder, const std::string& stem,
                                         const std::string& extension) {
  std::error_code code;
  std::filesystem::path file = folder / (stem + extension);
  for (int i = 2; std::filesystem::exists(file, code); ++i) file = folder / (stem + " " + std::to_string(i) + extension);
  return file;
}

// The file name without its folder.
inline std::string base_name(const std::string& file) { return std::filesystem::path(file).filename().string(); }

}  // namespace etendue::viewer
