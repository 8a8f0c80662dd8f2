// Tiled, mip-mapped files and the cache of their tiles.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "image/plugin_interface.h"

namespace etendue::openimageio {

// These implement the functions of ImagePlugin.
void set_tile_memory(uint64_t bytes);
Result<std::shared_ptr<const image::TiledImage>> open_tiles(const std::string& file, uint64_t hash);
Result<void> write_tiles(const image::Image& image, bool srgb, const std::string& file);

}  // namespace etendue::openimageio
