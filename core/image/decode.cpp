#include <cstring>

#include "base/file.h"
#include "image/codecs.h"

namespace etendue::image {
namespace {

bool starts(Bytes bytes, std::string_view magic, size_t at = 0) {
  return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

// Any decoded picture as RGB floats in Rec. 709.
LayeredImage linear_of(const Image& image) {
  LayeredImage out;
  out.width = image.width, out.height = image.height;
  Layer layer{"", {"R", "G", "B"}, {}};
  const auto channels = static_cast<size_t>(image.channels);
  const size_t pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  layer.pixels.reserve(pixels * 3);
  for (size_t i = 0; i < pixels; ++i)
    for (size_t c = 0; c < 3; ++c) {
      const size_t at = i * channels + (channels < 3 ? 0 : c);
      layer.pixels.push_back(image.type == PixelType::float32 ? image.floats[at]
                                                               : srgb_to_linear(static_cast<float>(image.bytes[at]) / 255.0f));
    }
  out.layers.push_back(std::move(layer));
  return out;
}

}  // namespace

bool is_png(Bytes b) { return starts(b, "\x89PNG\r\n\x1a\n"); }
bool is_jpeg(Bytes b) { return starts(b, "\xff\xd8\xff"); }
bool is_webp(Bytes b) { return starts(b, "RIFF") && starts(b, "WEBP", 8); }
bool is_hdr(Bytes b) { return starts(b, "#?RADIANCE") || starts(b, "#?RGBE"); }
bool is_exr(Bytes b) { return starts(b, "\x76\x2f\x31\x01"); }

const Layer* LayeredImage::find(const std::string& name) const {
  for (const auto& layer : layers)
    if (layer.name == name) return &layer;
  return nullptr;
}

Result<Image> decode_image(Bytes bytes, const std::string& name) {
  if (is_png(bytes)) return decode_png(bytes, name);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, name);
  if (is_webp(bytes)) return decode_webp(bytes, name);
  if (is_hdr(bytes)) return decode_hdr(bytes, name);
  return input_error(name + ": this is no picture that can be read; give PNG, JPEG, WebP or Radiance HDR");
}

Result<LayeredImage> read_linear(const std::filesystem::path& path) {
  auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  if (is_exr(*bytes)) return read_exr(path);
  auto image = decode_image(*bytes, path.string());
  if (!image) return image.error();
  return linear_of(*image);
}

}  // namespace etendue::image
