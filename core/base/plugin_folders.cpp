#include "base/plugin_folders.h"

#include <cstdlib>

namespace etendue {

std::vector<std::filesystem::path> plugin_folders() {
  namespace fs = std::filesystem;
  if (const char* folder = std::getenv("ETENDUE_PLUGIN_PATH")) return {folder};
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  return {program.parent_path(), program.parent_path().parent_path() / "lib" / "etendue"};
}

}  // namespace etendue
