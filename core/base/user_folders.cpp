#include "base/user_folders.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace etendue {
namespace {

namespace fs = std::filesystem;

// The folder of this program in the folder that a variable names, or in one of the home folder.
fs::path user_folder(const char* variable, const char* in_home) {
  const char* chosen = std::getenv(variable);
  const char* home = std::getenv("HOME");
  // The specification requires relative values to be ignored.
  if (chosen && fs::path(chosen).is_absolute()) return fs::path(chosen) / "etendue";
  return home && *home ? fs::path(home) / in_home / "etendue" : fs::path();
}

}  // namespace

fs::path config_folder() { return user_folder("XDG_CONFIG_HOME", ".config"); }
fs::path state_folder() { return user_folder("XDG_STATE_HOME", ".local/state"); }
fs::path data_folder() { return user_folder("XDG_DATA_HOME", ".local/share"); }
fs::path cache_folder() { return user_folder("XDG_CACHE_HOME", ".cache"); }

fs::path pictures_folder() {
  const char* home = std::getenv("HOME");
  if (!home || !*home) return {};
  // Lines are XDG_PICTURES_DIR="$HOME/Pictures" or have an absolute path.
  constexpr std::string_view kStart = "XDG_PICTURES_DIR=\"", kHome = "$HOME";
  fs::path folder = fs::path(home) / "Pictures";
  std::ifstream file(config_folder().parent_path() / "user-dirs.dirs");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(kStart) || !line.ends_with('"')) continue;
    const std::string value = line.substr(kStart.size(), line.size() - kStart.size() - 1);
    folder = value.starts_with(kHome) ? home + value.substr(kHome.size()) : value;
  }
  std::error_code code;
  return folder.is_absolute() && fs::is_directory(folder, code) ? folder : fs::path();
}

}  // namespace etendue
