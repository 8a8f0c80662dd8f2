// The plugin for OpenImageIO: its exported function.
#include "read.h"
#include "tiles.h"
#include "write.h"

namespace etendue::openimageio {
namespace {

class Plugin final : public image::ImagePlugin {
 public:
  Result<image::Image> read(const image::PluginRead& request) const override { return read_image(request); }
  Result<void> write(const image::PluginWrite& request) const override { return write_image(request); }
  Result<void> write_tiles(const image::Image& image, bool srgb, const std::string& file) const override {
    return openimageio::write_tiles(image, srgb, file);
  }
  Result<std::shared_ptr<const image::TiledImage>> open_tiles(const std::string& file, uint64_t hash) const override {
    return openimageio::open_tiles(file, hash);
  }
  void set_tile_memory(uint64_t bytes) const override { openimageio::set_tile_memory(bytes); }
};

}  // namespace
}  // namespace etendue::openimageio

extern "C" [[gnu::visibility("default")]] const void* etendue_image_plugin(int version) {
  static const etendue::openimageio::Plugin plugin;
  return version == etendue::image::kPluginVersion ? static_cast<const etendue::image::ImagePlugin*>(&plugin) : nullptr;
}
