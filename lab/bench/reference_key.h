// The cache key of reference images.
#pragma once
#include <cstdint>

#include "render/document.h"

namespace etendue::bench {

// A hash of everything the image depends on: the content of the scene (geometry, textures, environment, the file
// itself) and all settings except the seed, the limits, the display and file names. It does not depend on the location
// of the scene file.
uint64_t image_key(const render::Document& document);

}  // namespace etendue::bench
