#include "medium/grid_plugin.h"

#include "base/load_plugin.h"

namespace etendue {
namespace {

constexpr PluginDescription kGridPluginDescription{"libetendue_openvdb.so", "OpenVDB", "libopenvdb10.0",
                                                   "the packages libopenvdb-dev, libblosc-dev and libboost-dev"};

}  // namespace

Result<const GridPlugin*> load_grid_plugin(const std::vector<std::filesystem::path>& folders) {
  const auto plugin = load_plugin(kGridPluginDescription, folders, kGetGridPlugin, kGridPluginVersion);
  if (!plugin) return plugin.error();
  return static_cast<const GridPlugin*>(*plugin);
}

Result<const GridPlugin*> grid_plugin() {
  static const Result<const GridPlugin*> plugin = load_grid_plugin(plugin_folders());
  return plugin;
}

}  // namespace etendue
