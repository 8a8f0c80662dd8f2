// The file dialog: folders, the files with suitable extensions, and a field for the name.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace etendue::viewer {

struct AppState;

class FileDialog {
 public:
  // Shows the dialog while there is a file request.
  void draw(AppState& state);

 private:
  void open(const AppState& state);
  void enter_folder(const std::filesystem::path& folder);
  void read_folder();
  // Draws folders and files. Returns true if a file was double-clicked.
  bool draw_list(AppState& state);
  // Handles the name that was entered. Returns true if the dialog is to be closed.
  bool accept(AppState& state);

  bool is_open_ = false;
  bool saves_ = false;
  std::vector<std::string> extensions_;
  std::string name_;
  std::string problem_;
  std::filesystem::path folder_;
  std::vector<std::string> folders_;
  std::vector<std::string> files_;
};

}  // namespace etendue::viewer
