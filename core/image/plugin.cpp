#include "image/plugin.h"

#include "base/load_plugin.h"

namespace etendue::image {
namespace {

constexpr PluginDescription kDescription{"libetendue_openimageio.so", "OpenImageIO", "libopenimageio2.4",
                                         "the package libopenimageio-dev"};

}  // namespace

Result<const ImagePlugin*> load_image_plugin(const std::vector<std::filesystem::path>& folders) {
  const auto plugin = load_plugin(kDescription, folders, kGetImagePlugin, kPluginVersion);
  if (!plugin) return plugin.error();
  return static_cast<const ImagePlugin*>(*plugin);
}

Result<const ImagePlugin*> image_plugin() {
  static const Result<const ImagePlugin*> plugin = load_image_plugin(plugin_folders());
  return plugin;
}

}  // namespace etendue::image
