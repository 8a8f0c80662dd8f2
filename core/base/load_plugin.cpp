#include "base/load_plugin.h"

#include <dlfcn.h>

#include <cstdlib>

namespace etendue {

namespace fs = std::filesystem;

std::vector<fs::path> plugin_folders() {
  if (const char* folder = std::getenv("ETENDUE_PLUGIN_PATH")) return {folder};
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  return {program.parent_path(), program.parent_path().parent_path() / "lib" / "etendue"};
}

Result<const void*> load_plugin(const PluginDescription& description, const std::vector<fs::path>& folders,
                                const char* get, int version) {
  const auto unavailable = [&](const std::string& reason) {
    return input_error("needs " + std::string(description.library) + ", " + reason);
  };
  for (const fs::path& folder : folders) {
    const fs::path file = folder / description.file;
    std::error_code code;
    if (!fs::exists(file, code)) continue;
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library)
      return unavailable("which cannot be loaded (" + std::string(dlerror()) + "); install the package " +
                         description.runtime_package);
    const auto function = reinterpret_cast<const void* (*)(int)>(dlsym(library, get));
    if (const void* plugin = function ? function(version) : nullptr) return plugin;
    return unavailable("but " + file.string() + " is of another version of this program; build both again");
  }
  return unavailable("but this program has no " + std::string(description.file) + "; install " + description.packages +
                     " and build again");
}

}  // namespace etendue
