// The decoders behind decode_image and read_linear, one format a file. Each learns the size of the picture from the
// header and has it checked before it takes memory for pixels.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "image/image.h"

namespace etendue::image {

using Bytes = std::span<const std::byte>;

inline constexpr uint64_t kMaxPixels = uint64_t{1} << 28;

// An error if the picture has no pixels, or more than kMaxPixels.
Result<void> check_size(uint64_t width, uint64_t height, const std::string& name);

// An error if `needed` bytes of file are more than there are: a short file that claims a large picture is cut off or
// lies.
Result<void> check_length(uint64_t needed, Bytes bytes, const std::string& name);

bool starts_with(Bytes bytes, std::string_view prefix);

bool is_exr(Bytes bytes);
bool is_hdr(Bytes bytes);
bool is_jpeg(Bytes bytes);
bool is_png(Bytes bytes);
bool is_webp(Bytes bytes);

Result<LayeredImage> decode_exr(Bytes bytes, const std::string& name);
Result<Image> decode_hdr(Bytes bytes, const std::string& name);
Result<Image> decode_jpeg(Bytes bytes, const std::string& name);
Result<Image> decode_png(Bytes bytes, const std::string& name);
Result<Image> decode_webp(Bytes bytes, const std::string& name);

// Storage for an 8-bit picture whose size has been checked.
Image make_byte_image(int width, int height, int channels);

}  // namespace etendue::image
