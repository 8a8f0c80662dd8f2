// PNG, through libpng
//
// Read: palettes and low bit depths are expanded, grey and alpha channels are kept, 16 bits are rounded to 8, which is
// enough for display-referred textures. gAMA, cHRM and iCCP are ignored, as glTF 2.0 requires for textures.
//
// Written: 8-bit sRGB with text chunks, and textures with the channels they have.
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "base/file.h"
#include "image/format.h"

namespace etendue::image {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

// The state of libpng. It reports an error by a long jump, which must not skip destructors: functions that call setjmp
// have no local objects with destructors.
struct PngState {
  png_structp png = nullptr;
  png_infop info = nullptr;
  char message[160] = "not enough memory";  // of the last error

  PngState() = default;
  PngState(const PngState&) = delete;
  PngState& operator=(const PngState&) = delete;
};

void on_error(png_structp png, png_const_charp message) {
  PngState& state = *static_cast<PngState*>(png_get_error_ptr(png));
  std::snprintf(state.message, sizeof state.message, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

// ---- Reading

struct Reader : PngState {
  Bytes bytes;
  size_t position = 0;

  explicit Reader(Bytes input) : bytes(input) {}
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void on_read(png_structp png, png_bytep target, size_t size) {
  Reader& reader = *static_cast<Reader*>(png_get_io_ptr(png));
  if (size > reader.bytes.size() - reader.position) png_error(png, "the file is truncated");
  std::memcpy(target, reader.bytes.data() + reader.position, size);
  reader.position += size;
}

bool read_header(Reader& reader) {
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, static_cast<PngState*>(&reader), on_error, on_warning);
  if (reader.png) reader.info = png_create_info_struct(reader.png);
  if (!reader.info) return false;
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_read_fn(reader.png, &reader, on_read);
  png_set_user_limits(reader.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_image_size decides instead
  png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(reader.png, reader.info);
  return true;
}

// Selects 8-bit samples, 1 to 4 per pixel; transparent colours become an alpha channel.
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

bool is_png(Bytes bytes) { return starts_with(bytes, "\x89PNG\r\n\x1a\n"); }

Result<Image> decode_png(Bytes bytes, const std::string& name) {
  Reader reader(bytes);
  const auto failed = [&] { return input_error(name + ": damaged PNG: " + reader.message); };
  if (!read_header(reader)) return failed();
  const uint64_t width = png_get_image_width(reader.png, reader.info);
  const uint64_t height = png_get_image_height(reader.png, reader.info);
  if (auto size = check_image_size(width, height, name); !size) return size.error();
  // Deflate expands a byte to at most 1032 bytes.
  const uint64_t stored = png_get_rowbytes(reader.png, reader.info) * height;
  if (auto length = check_file_length(stored / 1032, bytes, name); !length) return length.error();

  if (!choose_transforms(reader)) return failed();
  const int channels = png_get_channels(reader.png, reader.info);
  Image image = make_byte_image(static_cast<int>(width), static_cast<int>(height), channels);
  std::vector<png_bytep> rows(height);
  for (size_t y = 0; y < height; ++y) rows[y] = &image.bytes[y * width * static_cast<size_t>(channels)];
  if (!read_pixels(reader, rows.data())) return failed();
  return image;
}

uint64_t decoded_png_size(Bytes bytes) {
  Reader reader(bytes);
  if (!read_header(reader) || !choose_transforms(reader)) return 0;
  return uint64_t{png_get_image_height(reader.png, reader.info)} * png_get_rowbytes(reader.png, reader.info);
}

// ---- Writing

struct Writer : PngState {
  std::FILE* file;

  explicit Writer(std::FILE* output) : file(output) {}
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

// Text that is not ASCII is stored as UTF-8 in an iTXt chunk, because zTXt chunks are limited to Latin-1.
png_text text_chunk(const std::string& keyword, const std::string& text) {
  const bool ascii = std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  png_text chunk{};
  chunk.compression = ascii ? PNG_TEXT_COMPRESSION_zTXt : PNG_ITXT_COMPRESSION_zTXt;
  chunk.key = const_cast<char*>(keyword.c_str());  // libpng copies it
  chunk.text = const_cast<char*>(text.c_str());
  return chunk;
}

bool is_keyword(const std::string& keyword) {
  const auto printable = [](char c) { return c >= 32 && c < 127; };
  return !keyword.empty() && keyword.size() <= 79 && keyword.front() != ' ' && keyword.back() != ' ' &&
         keyword.find("  ") == std::string::npos && std::ranges::all_of(keyword, printable);
}

struct Encoding {
  png_uint_32 width, height;
  int depth = 8, color_type = PNG_COLOR_TYPE_RGB;
  bool srgb = true;  // declares the values as sRGB; not for textures, whose meaning depends on their use
};

bool write_chunks(Writer& writer, const Encoding& encoding, png_bytepp rows, png_const_textp texts, int text_count) {
  writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, static_cast<PngState*>(&writer), on_error, on_warning);
  if (writer.png) writer.info = png_create_info_struct(writer.png);
  if (!writer.info) return false;
  if (setjmp(png_jmpbuf(writer.png))) return false;
  png_init_io(writer.png, writer.file);
  png_set_user_limits(writer.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(writer.png, writer.info, encoding.width, encoding.height, encoding.depth, encoding.color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (encoding.srgb) png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (text_count > 0) png_set_text(writer.png, writer.info, texts, text_count);
  png_write_info(writer.png, writer.info);
  png_write_image(writer.png, rows);
  png_write_end(writer.png, nullptr);
  return true;
}

bool write_rgb(Writer& writer, int width, int height, std::span<const uint8_t> rgb,
               const std::vector<png_text>& texts) {
  std::vector<png_bytep> rows;
  for (size_t y = 0; y < static_cast<size_t>(height); ++y)
    rows.push_back(const_cast<png_bytep>(&rgb[y * static_cast<size_t>(width) * 3]));  // libpng does not modify them
  const Encoding encoding{.width = static_cast<png_uint_32>(width), .height = static_cast<png_uint_32>(height)};
  return write_chunks(writer, encoding, rows.data(), texts.data(), static_cast<int>(texts.size()));
}

// The bytes that `write` writes to a Writer.
template <class Write>
Result<std::vector<std::byte>> in_memory(Write&& write) {
  char* bytes = nullptr;
  size_t size = 0;
  File file(open_memstream(&bytes, &size), std::fclose);
  if (!file) return output_error("PNG: not enough memory");
  Writer writer(file.get());
  const bool written = write(writer);
  file.reset();  // flushes: sets `bytes` and `size`
  const std::unique_ptr<char, void (*)(void*)> owner(bytes, std::free);
  if (!written) return output_error(std::string("PNG: ") + writer.message);
  const auto* first = reinterpret_cast<const std::byte*>(bytes);
  return std::vector<std::byte>(first, first + size);
}

// Values in [0, 1] as 16-bit integers, big-endian as in PNG files.
std::vector<uint8_t> sixteen_bits(const std::vector<float>& values) {
  std::vector<uint8_t> bytes;
  bytes.reserve(values.size() * 2);
  for (const float value : values) {
    const auto v = static_cast<unsigned>(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535.0f));
    bytes.push_back(static_cast<uint8_t>(v >> 8));
    bytes.push_back(static_cast<uint8_t>(v & 0xff));
  }
  return bytes;
}

}  // namespace

Result<std::vector<std::byte>> encode_png(int width, int height, std::span<const uint8_t> rgb) {
  if (auto ok = check_rgb_size(width, height, rgb.size(), "PNG"); !ok) return ok.error();
  return in_memory([&](Writer& writer) { return write_rgb(writer, width, height, rgb, {}); });
}

Result<std::vector<std::byte>> encode_png(const Image& image) {
  static constexpr int kColorTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                        PNG_COLOR_TYPE_RGB_ALPHA};
  if (image.empty() || image.channels < 1 || image.channels > 4)
    return output_error("PNG: the image is empty, or has other than 1 to 4 channels");
  const bool wide = image.type == PixelType::float32;
  const std::vector<uint8_t> converted = wide ? sixteen_bits(image.floats) : std::vector<uint8_t>();
  const std::vector<uint8_t>& samples = wide ? converted : image.bytes;
  const size_t row = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels) * (wide ? 2 : 1);
  std::vector<png_bytep> rows;
  for (size_t y = 0; y < static_cast<size_t>(image.height); ++y)
    rows.push_back(const_cast<png_bytep>(&samples[y * row]));  // libpng does not modify them
  const Encoding encoding{.width = static_cast<png_uint_32>(image.width),
                          .height = static_cast<png_uint_32>(image.height),
                          .depth = wide ? 16 : 8,
                          .color_type = kColorTypes[image.channels - 1],
                          .srgb = false};
  return in_memory([&](Writer& writer) { return write_chunks(writer, encoding, rows.data(), nullptr, 0); });
}

Result<void> write_png(const std::filesystem::path& path, int width, int height, std::span<const uint8_t> rgb,
                       const std::map<std::string, std::string>& attributes) {
  if (auto ok = check_rgb_size(width, height, rgb.size(), path.string()); !ok) return ok;
  std::vector<png_text> texts;
  for (const auto& [keyword, text] : attributes) {
    if (!is_keyword(keyword))
      return output_error(path.string() + ": '" + keyword + "' is not a valid keyword of a PNG text chunk");
    texts.push_back(text_chunk(keyword, text));
  }
  return write_atomically(path, [&](const std::filesystem::path& temporary) -> Result<void> {
    File file(std::fopen(temporary.c_str(), "wb"), std::fclose);
    if (!file) return output_error(path.string() + ": cannot be written: " + std::strerror(errno));
    Writer writer(file.get());
    const bool encoded = write_rgb(writer, width, height, rgb, texts);
    if (std::ferror(file.get())) return incomplete_write(path);
    if (!encoded) return output_error(path.string() + ": cannot be written as PNG: " + writer.message);
    if (std::fclose(file.release()) != 0) return incomplete_write(path);
    return {};
  });
}

extern const ImageFormat kPngFormat{
    .name = "png",
    .label = "PNG",
    .extensions = {".png"},
    .doc = "Read: 8 and 16 bits, grey, colour and alpha. Written: display-encoded 8-bit RGB with text attributes.",
    .recognises = is_png,
    .decode = decode_png,
    .decoded_size = decoded_png_size,
    .write_display = write_png,
};

}  // namespace etendue::image
