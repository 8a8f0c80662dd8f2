// The map of an environment, from a file.
#pragma once
#include <filesystem>
#include <memory>

#include "base/result.h"
#include "image/image.h"

namespace etendue::scene {

// An equirectangular picture (.hdr, .exr, ...) as float RGB; what is no radiance (negative, not finite) becomes 0.
Result<std::shared_ptr<const image::Image>> load_environment_map(const std::filesystem::path& file);

}  // namespace etendue::scene
