// The library of material files, as a list of images; a click loads a material.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "viewer/widgets/thumbnails.h"

namespace etendue::viewer {

struct AppState;

class LibrarySection {
 public:
  void draw(AppState& state);

 private:
  // Reads the folder if it has changed.
  void read_folder(const AppState& state);
  void draw_file(AppState& state, const std::string& file, size_t index, float side);

  std::vector<std::string> files_;  // sorted
  std::string folder_;
  std::filesystem::file_time_type folder_time_{};  // of the last change of the folder that was read
  Thumbnails thumbnails_;
};

}  // namespace etendue::viewer
