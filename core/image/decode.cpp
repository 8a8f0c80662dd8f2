// Decoding of a file in memory, by the format of its content.
#include "image/format.h"
#include "image/plugin_io.h"

namespace etendue::image {

Result<Image> decode_image(std::span<const std::byte> bytes, const std::string& name) {
  const ImageFormat* format = recognise_format(bytes);
  if (format) return format->decode ? format->decode(bytes, name) : decode_by_plugin(bytes, name);
  if (bytes.empty()) return input_error(name + ": the file is empty");
  if (starts_with(bytes, "\xabKTX 20\xbb"))
    return input_error(name + ": KTX 2 images are not supported; convert the image to PNG or JPEG");
  return input_error(name + ": unknown image format; expected " + readable_formats());
}

}  // namespace etendue::image
