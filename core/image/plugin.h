// The plugin that reads and writes through OpenImageIO. It is loaded when it is used for the first time.
#pragma once
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "image/plugin_interface.h"

namespace etendue::image {

// The plugin; the first call loads it from plugin_folders(). The error says what to install.
Result<const ImagePlugin*> image_plugin();

// Loads the plugin from the first of these folders that has it.
Result<const ImagePlugin*> load_image_plugin(const std::vector<std::filesystem::path>& folders);

}  // namespace etendue::image
