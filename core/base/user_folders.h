// The folders of the user for files of this program, by the XDG base directory specification.
#pragma once
#include <filesystem>

namespace etendue {

// Each is empty if neither its variable nor HOME is set.

// Settings: $XDG_CONFIG_HOME/etendue or ~/.config/etendue.
std::filesystem::path config_folder();
// What is kept between runs but is not a setting: $XDG_STATE_HOME/etendue or ~/.local/state/etendue.
std::filesystem::path state_folder();
// Files of the user, such as the material library: $XDG_DATA_HOME/etendue or ~/.local/share/etendue.
std::filesystem::path data_folder();
// Files that can be computed again: $XDG_CACHE_HOME/etendue or ~/.cache/etendue.
std::filesystem::path cache_folder();

// The folder of the user's pictures: XDG_PICTURES_DIR of $XDG_CONFIG_HOME/user-dirs.dirs, or ~/Pictures. Empty if it does
// not exist.
std::filesystem::path pictures_folder();

}  // namespace etendue
