// One decoder and, where there is one, one encoder per file format; image.h is what the program uses.
#pragma once
#include "image/image.h"

namespace etendue::image {

using Bytes = std::span<const std::byte>;

bool is_png(Bytes bytes);
bool is_jpeg(Bytes bytes);
bool is_webp(Bytes bytes);
bool is_hdr(Bytes bytes);
bool is_exr(Bytes bytes);

Result<Image> decode_png(Bytes bytes, const std::string& name);
Result<Image> decode_jpeg(Bytes bytes, const std::string& name);
Result<Image> decode_webp(Bytes bytes, const std::string& name);
Result<Image> decode_hdr(Bytes bytes, const std::string& name);

// Larger pictures are refused before memory is taken for them.
inline constexpr int64_t kMostPixels = int64_t{1} << 28;

inline bool reasonable(int64_t width, int64_t height) {
  return width > 0 && height > 0 && width <= (1 << 20) && height <= (1 << 20) && width * height <= kMostPixels;
}

inline Error bad_picture(const std::string& name, const std::string& what) {
  return input_error(name + ": " + what + "; give an intact picture");
}

}  // namespace etendue::image
