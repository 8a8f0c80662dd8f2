// Readers and writers of ImageFormat that use the plugin (image/plugin.h).
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "base/result.h"
#include "image/image.h"

namespace etendue::image {

struct ImageFormat;

Result<Image> decode_by_plugin(std::span<const std::byte> bytes, const std::string& name);
Result<Image> read_linear_by_plugin(const std::filesystem::path& path, const ImageFormat& format);
Result<void> write_linear_by_plugin(const std::filesystem::path& path, int width, int height,
                                    std::span<const float> rgb);
// The attributes are not written.
Result<void> write_display_by_plugin(const std::filesystem::path& path, int width, int height,
                                     std::span<const uint8_t> rgb,
                                     const std::map<std::string, std::string>& attributes);

}  // namespace etendue::image
