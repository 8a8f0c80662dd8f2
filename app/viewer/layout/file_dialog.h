// The file dialog: places, folders, the files with suitable extensions and their dates and sizes, and an image of the
// selected file.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "viewer/widgets/thumbnails.h"

namespace etendue::viewer {

struct AppState;

class FileDialog {
 public:
  // Shows the dialog while there is a file request.
  void draw(AppState& state);

 private:
  struct Entry {
    std::string name;
    bool is_folder = false;
    uintmax_t bytes = 0;
    int64_t seconds = 0;  // of the last change, since 1970
  };
  struct Place {
    std::string label;
    std::filesystem::path folder;
  };

  void open(const AppState& state);
  void enter_folder(const std::filesystem::path& folder);
  void read_folder();
  void find_places(const AppState& state);
  // Lets the fonts have the characters of all names in the folder.
  void add_glyphs(AppState& state);
  void sort_entries();

  void draw_path(AppState& state);
  // The list of formats of a saved file, which changes the extension of the name.
  void draw_formats(AppState& state);
  void draw_places(AppState& state);
  // Returns true if a file was double-clicked.
  bool draw_list(AppState& state);
  bool draw_entry(AppState& state, const Entry& entry);
  void draw_preview(AppState& state);
  // Handles the name that was entered. Returns true if the dialog is to be closed.
  bool accept(AppState& state);
  // The file that the name stands for.
  std::filesystem::path selected_path() const;

  bool is_open_ = false;
  bool saves_ = false;
  std::vector<std::string> extensions_, formats_;
  std::string name_;
  std::string filter_;
  std::string problem_;
  std::string replaced_file_;  // the user was told that it exists
  std::filesystem::path folder_;
  std::vector<Place> places_;
  std::vector<Entry> entries_;
  bool has_new_entries_ = false;
  int sort_column_ = 0;  // name, change, size
  bool sort_descending_ = false;
  Thumbnails texture_;
};

}  // namespace etendue::viewer
