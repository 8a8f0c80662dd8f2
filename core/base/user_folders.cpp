#include "base/user_folders.h"

#include <cstdlib>

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
fs::path cache_folder() { return user_folder("XDG_CACHE_HOME", ".cache"); }

}  // namespace etendue
