// The colour space that a file declares.
#pragma once
#include <OpenImageIO/imageio.h>

#include <string>

#include "base/result.h"
#include "image/image.h"

namespace etendue::openimageio {

// The name of the colour space in the notation of OpenImageIO ("sRGB", "linear", "Rec709", "Gamma2.2"). Files without a
// declaration are sRGB if they hold integers and linear if they hold floats.
std::string color_space(const OIIO::ImageSpec& spec);

bool is_linear(const std::string& color_space);

// Decodes the colours of a float image; alpha stays unchanged. Unknown colour spaces are errors.
Result<void> to_linear(const std::string& color_space, image::Image& image, const std::string& name);

}  // namespace etendue::openimageio
