#include "base/cache_folder.h"

#include <cstdlib>

namespace etendue {

std::filesystem::path cache_folder() {
  namespace fs = std::filesystem;
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  // The XDG base directory specification requires relative values to be ignored.
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "etendue";
  return home && *home ? fs::path(home) / ".cache" / "etendue" : fs::path();
}

}  // namespace etendue
