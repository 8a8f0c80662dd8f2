// Reading PNG through libpng. Palettes and low bit depths are expanded, grey and alpha are kept, and 16 bits are
// reduced to 8: no display-referred texture shows the difference. gAMA, cHRM and iCCP are ignored, as glTF 2.0 demands
// of textures.
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "image/codecs.h"

namespace etendue::image {
namespace {

// libpng reports an error by a long jump, which must not pass objects with destructors: the functions that set the jump
// have none.
struct Reader {
  Bytes bytes;
  size_t at = 0;
  png_structp png = nullptr;
  png_infop info = nullptr;
  char message[160] = "not enough memory";

  explicit Reader(Bytes input) : bytes(input) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void on_error(png_structp png, png_const_charp message) {
  Reader& reader = *static_cast<Reader*>(png_get_error_ptr(png));
  std::snprintf(reader.message, sizeof reader.message, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep target, size_t size) {
  Reader& reader = *static_cast<Reader*>(png_get_io_ptr(png));
  if (size > reader.bytes.size() - reader.at) png_error(png, "the file is cut off");
  std::memcpy(target, reader.bytes.data() + reader.at, size);
  reader.at += size;
}

bool read_header(Reader& reader) {
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, on_error, on_warning);
  if (reader.png) reader.info = png_create_info_struct(reader.png);
  if (!reader.info) return false;
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_read_fn(reader.png, &reader, on_read);
  png_set_user_limits(reader.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_size has the say
  png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(reader.png, reader.info);
  return true;
}

// The picture as 8-bit samples, 1 to 4 a pixel; colour keys become alpha.
bool choose_transforms(Reader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_expand(reader.png);
  png_set_scale_16(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_pixels(Reader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

}  // namespace

bool is_png(Bytes bytes) { return starts_with(bytes, "\x89PNG\r\n\x1a\n"); }

Result<Image> decode_png(Bytes bytes, const std::string& name) {
  Reader reader(bytes);
  const auto failed = [&] { return input_error(name + ": damaged PNG: " + reader.message); };
  if (!read_header(reader)) return failed();
  const uint64_t width = png_get_image_width(reader.png, reader.info);
  const uint64_t height = png_get_image_height(reader.png, reader.info);
  if (auto size = check_size(width, height, name); !size) return size.error();
  // Deflate makes at most 1032 bytes of one.
  const uint64_t stored = png_get_rowbytes(reader.png, reader.info) * height;
  if (auto length = check_length(stored / 1032, bytes, name); !length) return length.error();

  if (!choose_transforms(reader)) return failed();
  const int channels = png_get_channels(reader.png, reader.info);
  Image image = make_byte_image(static_cast<int>(width), static_cast<int>(height), channels);
  std::vector<png_bytep> rows(height);
  for (size_t y = 0; y < height; ++y) rows[y] = &image.bytes[y * width * static_cast<size_t>(channels)];
  if (!read_pixels(reader, rows.data())) return failed();
  return image;
}

}  // namespace etendue::image
