// What a picture depends on, as a number: under which a reference is found again.
#pragma once
#include <cstdint>

#include "render/document.h"

namespace etendue::bench {

// A hash of the scene's content (geometry, textures, environment, the file itself) and of every setting but the seed,
// the limits, the display and the name of the file. Equal for the same scene in another place.
uint64_t picture_key(const render::Document& document);

}  // namespace etendue::bench
