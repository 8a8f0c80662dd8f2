// What the viewer remembers from one day to the next, in the XDG directories.
#pragma once
#include <string>
#include <vector>

#include "viewer/platform/platform.h"

namespace etendue::viewer {

struct Settings {
  WindowPlace window;
  float column = 0;  // width of the right column in units of the interface; 0 until the user moved it
  float drawer = 0;  // height of the drawer, likewise
  bool dark = true;
  std::vector<std::string> recent;  // newest first
  std::string folder;               // where the user last opened or saved
};

// An absent file gives what a new user gets. One that cannot be read is set aside, and `note` says where.
Settings load_settings(std::string& note);
// False if the folder cannot be written; nothing depends on it.
bool save_settings(const Settings& settings);

void remember_recent(Settings& settings, const std::string& file);

}  // namespace etendue::viewer
