// Reading and writing through OpenImageIO, in a plugin that is loaded when it is used for the first time.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "image/format.h"
#include "image/image.h"
#include "image/plugin_interface.h"

namespace etendue::image {

// The plugin; the first call loads it. It is searched for in the folder that the environment variable
// ETENDUE_PLUGIN_PATH names, or, if that is not set, in the folder of the program and in ../lib/etendue relative to it.
// The error says what to install.
Result<const ImagePlugin*> image_plugin();

// Loads the plugin from the first of these folders that has it.
Result<const ImagePlugin*> load_image_plugin(const std::vector<std::filesystem::path>& folders);

// Readers and writers of ImageFormat that use the plugin.
Result<Image> decode_by_plugin(std::span<const std::byte> bytes, const std::string& name);
Result<Image> read_linear_by_plugin(const std::filesystem::path& path, const ImageFormat& format);
Result<void> write_linear_by_plugin(const std::filesystem::path& path, int width, int height,
                                    std::span<const float> rgb);
// The attributes are not written.
Result<void> write_display_by_plugin(const std::filesystem::path& path, int width, int height,
                                     std::span<const uint8_t> rgb,
                                     const std::map<std::string, std::string>& attributes);

}  // namespace etendue::image
