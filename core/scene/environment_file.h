// Loads environment maps.
#pragma once
#include <filesystem>
#include <memory>

#include "base/result.h"
#include "image/image.h"

namespace etendue::scene {

// Loads an equirectangular image (.hdr, .exr, ...) as linear RGB radiance in floats. Values that are negative or not
// finite become 0. Errors name the file.
Result<std::shared_ptr<const image::Image>> load_environment_map(const std::filesystem::path& file);

}  // namespace etendue::scene
