#include <webp/decode.h>

#include "image/codecs.h"

namespace etendue::image {

Result<Image> decode_webp(Bytes bytes, const std::string& name) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) return bad_picture(name, "WebP: damaged header");
  if (features.has_animation) return bad_picture(name, "WebP: an animation");
  if (!reasonable(features.width, features.height)) return bad_picture(name, "WebP of an absurd size");
  Image image;
  image.width = features.width, image.height = features.height, image.channels = 4;
  image.bytes.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 4);
  if (!WebPDecodeRGBAInto(data, bytes.size(), image.bytes.data(), image.bytes.size(), image.width * 4))
    return bad_picture(name, "WebP: damaged or truncated");
  return image;
}

}  // namespace etendue::image
