#include "medium/grid_plugin.h"

#include <dlfcn.h>

#include "base/plugin_folders.h"

namespace etendue {
namespace {

constexpr const char* kGridPluginFile = "libetendue_openvdb.so";

}  // namespace

Result<const GridPlugin*> load_grid_plugin(const std::vector<std::filesystem::path>& folders) {
  const auto unavailable = [](const std::string& reason) { return input_error("needs OpenVDB, " + reason); };
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path file = folder / kGridPluginFile;
    std::error_code code;
    if (!std::filesystem::exists(file, code)) continue;
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library)
      return unavailable("which cannot be loaded (" + std::string(dlerror()) + "); install the package libopenvdb10.0");
    const auto get = reinterpret_cast<GetGridPlugin>(dlsym(library, kGetGridPlugin));
    if (const GridPlugin* plugin = get ? get(kGridPluginVersion) : nullptr) return plugin;
    return unavailable("but " + file.string() + " is of another version of this program; build both again");
  }
  return unavailable(std::string("but this program has no ") + kGridPluginFile +
                     "; install the packages libopenvdb-dev and libboost-dev and build again");
}

Result<const GridPlugin*> grid_plugin() {
  static const Result<const GridPlugin*> plugin = load_grid_plugin(plugin_folders());
  return plugin;
}

}  // namespace etendue
