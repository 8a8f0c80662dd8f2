// Loads environments.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "base/result.h"
#include "image/image.h"
#include "light/environment.h"

namespace etendue::scene {

// Loads an equirectangular image (.hdr, .exr, ...) as linear RGB radiance in floats. Values that are negative or not
// finite become 0. Errors name the file.
Result<std::shared_ptr<const image::Image>> load_environment_map(const std::filesystem::path& file);

// The environment of such a file, or the built-in one of this name.
Result<Environment> load_environment(const std::string& file_or_name);

}  // namespace etendue::scene
