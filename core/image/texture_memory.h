// Textures within a memory budget
//
// If the decoded textures of a scene need more memory than the budget, they are converted to tiled, mip-mapped files in
// the cache folder, and rendering reads tiles of these files through OpenImageIO's cache. The budget belongs to the
// process, because all scenes share the cache of tiles.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/result.h"
#include "image/tiled_image.h"

namespace etendue::image {

inline constexpr uint64_t kUnlimitedTextureMemory = 0;

// The budget in bytes; kUnlimitedTextureMemory at the start. Set it before scenes are loaded.
void set_texture_memory(uint64_t bytes);
uint64_t texture_memory();

// A size in bytes from a number with an optional suffix K, M, G or T (powers of 1024): "512M", "1.5G".
Result<uint64_t> parse_memory_size(const std::string& text);

// The memory of the pixels of an encoded image; 0 if it is damaged. The header suffices for PNG, JPEG and WebP; images
// of other formats are decoded.
uint64_t decoded_size(std::span<const std::byte> bytes, const std::string& name);

// The tiles of an encoded image, from the file "textures/HASH.tx" of the cache folder, which is made if it is missing.
// Colours of 8-bit images are averaged as linear values if `srgb`. One image is converted at a time, to bound the
// memory of conversions.
Result<std::shared_ptr<const TiledImage>> stored_tiles(std::span<const std::byte> bytes, const std::string& name,
                                                       bool srgb);

}  // namespace etendue::image
