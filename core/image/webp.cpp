// WebP still images, lossy and lossless, through libwebp; for the glTF extension EXT_texture_webp.
#include <webp/decode.h>

#include <cstring>
#include <memory>

#include "image/format.h"
#include "image/plugin_io.h"

namespace etendue::image {
namespace {

bool is_webp(Bytes bytes) {
  return starts_with(bytes, "RIFF") && bytes.size() >= 12 && starts_with(bytes.subspan(8), "WEBP");
}

Result<Image> decode_webp(Bytes bytes, const std::string& name) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
    return input_error(name + ": the WebP header is damaged or truncated");
  if (features.has_animation) return input_error(name + ": animated WebP is not supported; expected a still image");
  if (auto size = check_image_size(static_cast<uint64_t>(features.width), static_cast<uint64_t>(features.height), name);
      !size)
    return size.error();

  // Decodes into a buffer of libwebp, which is touched only as far as rows are decoded, so that a wrong header costs
  // nothing.
  int width = 0, height = 0;
  const auto decode_pixels = features.has_alpha ? WebPDecodeRGBA : WebPDecodeRGB;
  const std::unique_ptr<uint8_t, void (*)(void*)> pixels(decode_pixels(data, bytes.size(), &width, &height), WebPFree);
  if (!pixels) return input_error(name + ": the WebP data are damaged or truncated");
  Image image = make_byte_image(width, height, features.has_alpha ? 4 : 3);
  std::memcpy(image.bytes.data(), pixels.get(), image.bytes.size());
  return image;
}

uint64_t decoded_webp_size(Bytes bytes) {
  WebPBitstreamFeatures features;
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) return 0;
  return static_cast<uint64_t>(features.width) * static_cast<uint64_t>(features.height) * (features.has_alpha ? 4 : 3);
}

}  // namespace

extern const ImageFormat kWebpFormat{
    .name = "webp",
    .label = "WebP",
    .extensions = {".webp"},
    .doc = "Read: still images, lossy and lossless, with alpha. Written: display-encoded, through OpenImageIO.",
    .recognises = is_webp,
    .decode = decode_webp,
    .decoded_size = decoded_webp_size,
    .write_display = write_display_by_plugin,
    .writes_by_plugin = true,
};

}  // namespace etendue::image
