// The plugin for OpenImageIO: its exported function.
#include <cstdlib>

#include "read.h"
#include "write.h"

namespace etendue::openimageio {
namespace {

class Plugin final : public image::ImagePlugin {
 public:
  Result<image::Image> read(const image::PluginRead& request) const override { return read_image(request); }
  Result<void> write(const image::PluginWrite& request) const override { return write_image(request); }
};

}  // namespace
}  // namespace etendue::openimageio

extern "C" [[gnu::visibility("default")]] const etendue::image::ImagePlugin* etendue_image_plugin(int version) {
  static const etendue::openimageio::Plugin plugin;
  return version == etendue::image::kPluginVersion ? &plugin : nullptr;
}
