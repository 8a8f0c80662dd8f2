// PNG by libpng's simplified interface; 16-bit pictures are read as 8-bit, as textures need no more.
#include <png.h>

#include <cstring>

#include "base/file.h"
#include "image/codecs.h"

namespace etendue::image {
namespace {

void append(png_structp png, png_bytep data, size_t size) {
  auto* out = static_cast<std::vector<uint8_t>*>(png_get_io_ptr(png));
  out->insert(out->end(), data, data + size);
}

void flush(png_structp) {}

struct Writer {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

}  // namespace

Result<Image> decode_png(Bytes bytes, const std::string& name) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size())) return bad_picture(name, std::string("PNG: ") + header.message);
  if (!reasonable(header.width, header.height)) {
    png_image_free(&header);
    return bad_picture(name, "PNG of an absurd size");
  }
  const bool color = (header.format & PNG_FORMAT_FLAG_COLOR) != 0, alpha = (header.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  header.format = color ? (alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB) : (alpha ? PNG_FORMAT_GA : PNG_FORMAT_GRAY);
  // Colour chunks do not count in glTF: bytes are taken as they stand.
  header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  Image image;
  image.width = static_cast<int>(header.width), image.height = static_cast<int>(header.height);
  image.channels = (color ? 3 : 1) + (alpha ? 1 : 0);
  image.bytes.resize(PNG_IMAGE_SIZE(header));
  if (!png_image_finish_read(&header, nullptr, image.bytes.data(), 0, nullptr)) return bad_picture(name, std::string("PNG: ") + header.message);
  return image;
}

Result<void> write_png(const std::filesystem::path& path, int width, int height, std::span<const uint8_t> rgb,
                       const std::map<std::string, std::string>& attributes) {
  std::vector<uint8_t> file;
  Writer w;
  std::vector<png_text> texts;
  std::vector<png_bytep> rows;
  for (const auto& [key, value] : attributes) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_zTXt;
    text.key = const_cast<char*>(key.c_str());
    text.text = const_cast<char*>(value.c_str());
    text.text_length = value.size();
    texts.push_back(text);
  }
  for (int y = 0; y < height; ++y) rows.push_back(const_cast<uint8_t*>(rgb.data()) + static_cast<size_t>(y) * static_cast<size_t>(width) * 3);
  if (setjmp(png_jmpbuf(w.png))) return output_error(path.string() + ": cannot be encoded as PNG");
  png_set_write_fn(w.png, &file, append, flush);
  png_set_IHDR(w.png, w.info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(w.png, w.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_text(w.png, w.info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(w.png, w.info);
  png_write_image(w.png, rows.data());
  png_write_end(w.png, nullptr);
  return write_file(path, file.data(), file.size());
}

}  // namespace etendue::image
