// The plugin for OpenVDB: its exported function.
#include <blosc.h>

#include "medium/grid_plugin_interface.h"
#include "read_vdb.h"

namespace etendue::vdb {
namespace {

class Plugin final : public GridPlugin {
 public:
  Result<GridValues> read_vdb(std::span<const std::byte> bytes, const std::string& name,
                              size_t most_voxels) const override {
    return vdb::read_vdb(bytes, name, most_voxels);
  }
  bool decompress_blosc(std::span<const std::byte> from, std::span<std::byte> to) const override {
    size_t size = 0;
    if (blosc_cbuffer_validate(from.data(), from.size(), &size) < 0 || size != to.size()) return false;
    return blosc_decompress_ctx(from.data(), to.data(), to.size(), 1) == static_cast<int>(to.size());
  }
};

}  // namespace
}  // namespace etendue::vdb

extern "C" [[gnu::visibility("default")]] const void* etendue_grid_plugin(int version) {
  static const etendue::vdb::Plugin plugin;
  return version == etendue::kGridPluginVersion ? static_cast<const etendue::GridPlugin*>(&plugin) : nullptr;
}
