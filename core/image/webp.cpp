// WebP stills, lossy and lossless (EXT_texture_webp).
#include <webp/decode.h>

#include <cstring>
#include <memory>

#include "image/codecs.h"

namespace etendue::image {

bool is_webp(Bytes bytes) {
  return starts_with(bytes, "RIFF") && bytes.size() >= 12 && starts_with(bytes.subspan(8), "WEBP");
}

Result<Image> decode_webp(Bytes bytes, const std::string& name) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
    return input_error(name + ": the WebP header is damaged or cut off");
  if (features.has_animation) return input_error(name + ": this WebP is an animation; give a still picture");
  if (auto size = check_size(static_cast<uint64_t>(features.width), static_cast<uint64_t>(features.height), name);
      !size)
    return size.error();

  // libwebp's own buffer is touched only as far as rows are decoded, so that a lying header costs nothing.
  int width = 0, height = 0;
  const auto decode = features.has_alpha ? WebPDecodeRGBA : WebPDecodeRGB;
  const std::unique_ptr<uint8_t, void (*)(void*)> pixels(decode(data, bytes.size(), &width, &height), WebPFree);
  if (!pixels) return input_error(name + ": the WebP data are damaged or cut off");
  Image image = make_byte_image(width, height, features.has_alpha ? 4 : 3);
  std::memcpy(image.bytes.data(), pixels.get(), image.bytes.size());
  return image;
}

}  // namespace etendue::image
