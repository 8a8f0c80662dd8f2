// Radiance RGBE pictures.
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <memory>

#include "base/file.h"
#include "image/codecs.h"

namespace etendue::image {

Result<Image> decode_hdr(Bytes bytes, const std::string& name) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(std::min<size_t>(bytes.size(), INT32_MAX));
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) return bad_picture(name, "HDR: damaged header");
  if (!reasonable(width, height)) return bad_picture(name, "HDR of an absurd size");
  const std::unique_ptr<float, void (*)(void*)> pixels(stbi_loadf_from_memory(data, size, &width, &height, &channels, 3), stbi_image_free);
  if (!pixels) return bad_picture(name, std::string("HDR: ") + stbi_failure_reason());
  Image image;
  image.width = width, image.height = height, image.channels = 3, image.type = PixelType::float32;
  image.floats.assign(pixels.get(), pixels.get() + static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
  return image;
}

Result<void> write_hdr(const std::filesystem::path& path, int width, int height, std::span<const float> rgb) {
  std::vector<uint8_t> file;
  const auto append = [](void* context, void* data, int size) {
    auto* out = static_cast<std::vector<uint8_t>*>(context);
    const auto* bytes = static_cast<const uint8_t*>(data);
    out->insert(out->end(), bytes, bytes + size);
  };
  if (!stbi_write_hdr_to_func(append, &file, width, height, 3, rgb.data())) return output_error(path.string() + ": cannot be encoded as HDR");
  return write_file(path, file.data(), file.size());
}

}  // namespace etendue::image
