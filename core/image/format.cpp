// Recognises a picture by its first bytes and hands it to the decoder of its format.
#include <cstring>

#include "image/codecs.h"

namespace etendue::image {

bool starts_with(Bytes bytes, std::string_view prefix) {
  return bytes.size() >= prefix.size() && std::memcmp(bytes.data(), prefix.data(), prefix.size()) == 0;
}

Result<void> check_size(uint64_t width, uint64_t height, const std::string& name) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width == 0 || height == 0) return input_error(name + ": the picture is empty (" + size + " pixels)");
  if (width > kMaxPixels || height > kMaxPixels / width)
    return input_error(name + ": the picture claims " + size + " pixels; at most 2^28 can be read");
  return {};
}

Result<void> check_length(uint64_t needed, Bytes bytes, const std::string& name) {
  if (bytes.size() >= needed) return {};
  return input_error(name + ": " + std::to_string(bytes.size()) +
                     " bytes are too few for the picture that the header claims; the file is cut off or damaged");
}

Image make_byte_image(int width, int height, int channels) {
  Image image;
  image.width = width, image.height = height, image.channels = channels;
  image.bytes.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
  return image;
}

Result<Image> decode_image(std::span<const std::byte> bytes, const std::string& name) {
  if (is_png(bytes)) return decode_png(bytes, name);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, name);
  if (is_webp(bytes)) return decode_webp(bytes, name);
  if (is_hdr(bytes)) return decode_hdr(bytes, name);
  if (bytes.empty()) return input_error(name + ": the file is empty");
  if (is_exr(bytes)) return input_error(name + ": OpenEXR cannot be used here; give PNG, JPEG, WebP or Radiance HDR");
  return input_error(name + ": the format is not known; PNG, JPEG, WebP and Radiance HDR can be read");
}

}  // namespace etendue::image
