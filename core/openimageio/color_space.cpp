#include "color_space.h"

#include <OpenImageIO/color.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>

#include "spectrum/rgb.h"

namespace etendue::openimageio {

std::string color_space(const OIIO::ImageSpec& spec) {
  const std::string declared = spec.get_string_attribute("oiio:ColorSpace");
  // Netpbm files follow Rec. 709 by their specification and sRGB in practice, also in this program's output.
  const bool is_netpbm = spec.get_int_attribute("pnm:binary", -1) >= 0;
  if (!declared.empty() && !(is_netpbm && declared == "Rec709")) return declared;
  return spec.format.is_floating_point() ? "linear" : "sRGB";
}

bool is_linear(const std::string& color_space) {
  static constexpr std::array<const char*, 5> kNames{"linear", "Linear", "scene_linear", "lin_srgb", "lin_rec709"};
  return std::ranges::find(kNames, color_space) != kNames.end();
}

Result<void> to_linear(const std::string& color_space, image::Image& image, const std::string& name) {
  if (is_linear(color_space)) return {};
  const auto channels = static_cast<size_t>(image.channels);
  if (color_space == "sRGB") {
    const size_t colors = channels >= 3 ? 3 : 1;
    for (size_t i = 0; i + channels <= image.floats.size(); i += channels)
      for (size_t c = 0; c < colors; ++c) image.floats[i + c] = srgb_to_linear(image.floats[i + c]);
    return {};
  }
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf pixels(spec, image.floats.data());
  if (OIIO::ImageBufAlgo::colorconvert(pixels, pixels, color_space, "linear", false)) return {};
  return input_error(name + ": the colour space '" + color_space +
                     "' is not known; convert the image to sRGB or linear");
}

}  // namespace etendue::openimageio
