// Decoding of images with one reader.
#pragma once
#include <cmath>

#include "image/format.h"
#include "integration/fuzz/target.h"

namespace etendue::fuzz {

// Decodes the input with the reader of this name, whatever its first bytes are.
inline void decode(Input input, std::string_view format_name) {
  for (const image::ImageFormat* format : image::image_formats()) {
    if (format->name != format_name) continue;
    if (format->decode_layers) (void)format->decode_layers(input, "input");
    if (!format->decode) continue;
    const auto decoded = format->decode(input, "input");
    if (!decoded) continue;
    const size_t values = static_cast<size_t>(decoded->width) * static_cast<size_t>(decoded->height) *
                          static_cast<size_t>(decoded->channels);
    require(std::max(decoded->bytes.size(), decoded->floats.size()) == values, "an image has too few pixels");
  }
}

}  // namespace etendue::fuzz
