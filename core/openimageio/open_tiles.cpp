#include <OpenImageIO/imagecache.h>

#include <algorithm>
#include <cstring>

#include "message.h"
#include "read.h"
#include "tiles.h"

namespace etendue::openimageio {
namespace {

using image::Image;
using image::PixelType;

// One cache for the process, which is never destroyed: images may outlive any owner.
OIIO::ImageCache& tile_cache() {
  static OIIO::ImageCache* cache = [] {
    OIIO::ImageCache* made = OIIO::ImageCache::create(false);
    made->attribute("forcefloat", 0);
    made->attribute("max_open_files", 500);
    return made;
  }();
  return *cache;
}

class TiledFile final : public image::TiledImage {
 public:
  TiledFile(const std::string& file, const OIIO::ImageSpec& spec, uint64_t file_hash)
      : file_(file), handle_(tile_cache().get_image_handle(file_)), tile_width_(spec.tile_width) {
    width = spec.width;
    height = spec.height;
    channels = spec.nchannels;
    type = spec.format == OIIO::TypeDesc::UINT8 ? PixelType::byte8 : PixelType::float32;
    tile_cache().get_image_info(file_, 0, 0, OIIO::ustring("miplevels"), OIIO::TypeDesc::INT, &levels);
    hash = file_hash;
  }

  bool read(int level, const std::array<Vec2i, 4>& positions, Texels<uint8_t>& texels) const override {
    return read_texels(level, positions, texels);
  }
  bool read(int level, const std::array<Vec2i, 4>& positions, Texels<float>& texels) const override {
    return read_texels(level, positions, texels);
  }

  Result<Image> pixels() const override {
    return read_image({.path = file_.string(),
                       .name = file_.string(),
                       .values = image::PluginValues::texture,
                       .check_size = [](uint64_t, uint64_t, const std::string&) { return Result<void>(); }});
  }

 private:
  // Neighbouring texels are mostly in one tile, which is then looked up once.
  template <class Value>
  bool read_texels(int level, const std::array<Vec2i, 4>& positions, Texels<Value>& texels) const {
    OIIO::ImageCache& cache = tile_cache();
    OIIO::ImageCache::Tile* tile = nullptr;
    Vec2i corner(0);
    const Value* values = nullptr;
    const auto count = static_cast<size_t>(channels), row = static_cast<size_t>(tile_width_);
    for (size_t i = 0; i < positions.size(); ++i) {
      const Vec2i place = positions[i], first = place / tile_width_ * tile_width_;
      if (!tile || first != corner) {
        if (tile) cache.release_tile(tile);
        tile = cache.get_tile(handle_, nullptr, 0, level, place.x, place.y, 0);
        if (!tile) return false;
        OIIO::TypeDesc format;
        values = static_cast<const Value*>(cache.tile_pixels(tile, format));
        corner = first;
      }
      const Vec2i inside = place - corner;
      const size_t at = (static_cast<size_t>(inside.y) * row + static_cast<size_t>(inside.x)) * count;
      std::memcpy(texels[i].data(), values + at, count * sizeof(Value));
    }
    cache.release_tile(tile);
    return true;
  }

  OIIO::ustring file_;
  OIIO::ImageCache::ImageHandle* handle_;
  int tile_width_;  // also the height
};

}  // namespace

void set_tile_memory(uint64_t bytes) { tile_cache().attribute("max_memory_MB", static_cast<float>(bytes) / 0x1p20f); }

Result<std::shared_ptr<const image::TiledImage>> open_tiles(const std::string& file, uint64_t hash) try {
  OIIO::ImageSpec spec;
  if (!tile_cache().get_imagespec(OIIO::ustring(file), spec, 0, 0)) {
    const std::string problem = tile_cache().geterror();
    tile_cache().invalidate(OIIO::ustring(file));  // forgets that the file is missing
    return input_error(cleaned(problem, file));
  }
  if (spec.tile_width == 0 || spec.tile_width != spec.tile_height || spec.nchannels > image::TiledImage::kMaxChannels)
    return input_error(file + ": is not a texture that this program has stored; remove it");
  return std::shared_ptr<const image::TiledImage>(std::make_shared<TiledFile>(file, spec, hash));
} catch (const std::exception& error) {
  return input_error(cleaned(error.what(), file));
}

}  // namespace etendue::openimageio
