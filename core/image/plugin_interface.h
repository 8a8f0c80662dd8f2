// What core/openimageio offers to core/image
//
// OpenImageIO depends on about 260 shared libraries, which take a third of a second to load. Its code is therefore in a
// plugin: a shared library that image/plugin.h loads when it is used for the first time. The plugin and the program are
// built together; kPluginVersion detects a plugin of another build.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/result.h"
#include "image/image.h"
#include "image/tiled_image.h"

namespace etendue::image {

// Increase it with every change of this file, of Image or of TiledImage.
inline constexpr int kPluginVersion = 2;

// The values of a decoded image.
enum class PluginValues : uint8_t {
  // For textures: integers as 8-bit values of unknown encoding, floats and integers that the file declares as linear as
  // linear floats. Alpha is not premultiplied.
  texture,
  // For images: linear floats with Rec. 709 primaries, decoded from the colour space that the file declares. Without a
  // declaration, integers are sRGB and floats are linear.
  linear,
};

struct PluginRead {
  std::string path;
  std::string name;         // in messages
  std::string format = {};  // extension without dot; selects the reader if that of the path does not
  PluginValues values = PluginValues::texture;
  // Called with the size in the header before memory is allocated for the pixels.
  Result<void> (*check_size)(uint64_t width, uint64_t height, const std::string& name) = nullptr;
};

// An RGB image to write: linear floats or sRGB bytes, the other is empty.
struct PluginWrite {
  std::string path = {};  // the extension selects the format
  std::string name = {};  // in messages
  int width = 0, height = 0;
  std::span<const float> linear = {};
  std::span<const uint8_t> display = {};
};

class ImagePlugin {
 public:
  // All functions catch all exceptions. Errors are messages for users.
  virtual Result<Image> read(const PluginRead& request) const = 0;
  virtual Result<void> write(const PluginWrite& request) const = 0;

  // Writes a tiled, mip-mapped file. Colours of 8-bit images are averaged as linear values if `srgb`.
  virtual Result<void> write_tiles(const Image& image, bool srgb, const std::string& file) const = 0;
  // Opens such a file. `hash` becomes TiledImage::hash.
  virtual Result<std::shared_ptr<const TiledImage>> open_tiles(const std::string& file, uint64_t hash) const = 0;
  // The memory of the cache for the tiles of all files, in bytes.
  virtual void set_tile_memory(uint64_t bytes) const = 0;

 protected:
  ~ImagePlugin() = default;
};

// The plugin exports `const void* etendue_image_plugin(int version)` (base/load_plugin.h), whose result points to an
// ImagePlugin.
inline constexpr const char* kGetImagePlugin = "etendue_image_plugin";

}  // namespace etendue::image
