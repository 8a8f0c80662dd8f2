// The settings that the viewer keeps between sessions, in $XDG_CONFIG_HOME/etendue/viewer.json.
#pragma once
#include <string>
#include <vector>

#include "viewer/platform/window_geometry.h"

namespace etendue::viewer {

struct Settings {
  WindowGeometry window;
  float column_width = 0;         // of the right column, units of the interface; 0 is the default width
  float bottom_panel_height = 0;  // units of the interface; 0 is the default height
  bool dark = true;
  std::vector<std::string> recent;  // newest first
  std::string folder;               // of the file that was last opened or saved
};

// Without a settings file, returns the defaults. A file that cannot be read is renamed to NAME.damaged; `note` then
// says so.
Settings load_settings(std::string& note);
// Returns false if the file cannot be written.
bool save_settings(const Settings& settings);

// Adds a file to the list of recent files and makes its folder the current one.
void remember_recent(Settings& settings, const std::string& file);

}  // namespace etendue::viewer
