// Writing PNG: 8-bit sRGB with text chunks, and textures as they are.
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
#include "image/image.h"

namespace etendue::image {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

// See png.cpp on long jumps.
struct Writer {
  std::FILE* file;
  png_structp png = nullptr;
  png_infop info = nullptr;
  char message[160] = "not enough memory";

  explicit Writer(std::FILE* output) : file(output) {}
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

void on_error(png_structp png, png_const_charp message) {
  Writer& writer = *static_cast<Writer*>(png_get_error_ptr(png));
  std::snprintf(writer.message, sizeof writer.message, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

// Latin-1 is all that tEXt and zTXt can hold; what is not ASCII goes to iTXt as UTF-8.
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

struct Format {
  png_uint_32 width, height;
  int depth = 8, color_type = PNG_COLOR_TYPE_RGB;
  bool srgb = true;  // says so; what a texture's numbers mean, only its use says
};

bool write_chunks(Writer& writer, const Format& format, png_bytepp rows, png_const_textp texts, int text_count) {
  writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, on_error, on_warning);
  if (writer.png) writer.info = png_create_info_struct(writer.png);
  if (!writer.info) return false;
  if (setjmp(png_jmpbuf(writer.png))) return false;
  png_init_io(writer.png, writer.file);
  png_set_user_limits(writer.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(writer.png, writer.info, format.width, format.height, format.depth, format.color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (format.srgb) png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (text_count > 0) png_set_text(writer.png, writer.info, texts, text_count);
  png_write_info(writer.png, writer.info);
  png_write_image(writer.png, rows);
  png_write_end(writer.png, nullptr);
  return true;
}

bool write_picture(Writer& writer, int width, int height, std::span<const uint8_t> rgb,
                   const std::vector<png_text>& texts) {
  std::vector<png_bytep> rows;
  for (size_t y = 0; y < static_cast<size_t>(height); ++y)
    rows.push_back(const_cast<png_bytep>(&rgb[y * static_cast<size_t>(width) * 3]));  // only read from
  const Format format{static_cast<png_uint_32>(width), static_cast<png_uint_32>(height)};
  return write_chunks(writer, format, rows.data(), texts.data(), static_cast<int>(texts.size()));
}

Result<void> check_size(const std::string& name, int width, int height, std::span<const uint8_t> rgb) {
  const size_t w = static_cast<size_t>(std::max(width, 0)), h = static_cast<size_t>(std::max(height, 0));
  if (!rgb.empty() && rgb.size() == w * h * 3) return {};
  return output_error(name + ": the pixels do not fill " + std::to_string(width) + " x " + std::to_string(height) +
                      " RGB");
}

// What `write` makes of a writer into memory.
template <class Write>
Result<std::vector<std::byte>> in_memory(Write&& write) {
  char* bytes = nullptr;
  size_t size = 0;
  File file(open_memstream(&bytes, &size), std::fclose);
  if (!file) return output_error("PNG: not enough memory");
  Writer writer(file.get());
  const bool written = write(writer);
  file.reset();  // only now are bytes and size those of the whole
  const std::unique_ptr<char, void (*)(void*)> owner(bytes, std::free);
  if (!written) return output_error(std::string("PNG: ") + writer.message);
  const auto* first = reinterpret_cast<const std::byte*>(bytes);
  return std::vector<std::byte>(first, first + size);
}

// Big-endian, as PNG has them.
std::vector<uint8_t> sixteen_bits(const std::vector<float>& values) {
  std::vector<uint8_t> bytes;
  bytes.reserve(values.size() * 2);
  for (const float value : values) {
    const auto v = static_cast<unsigned>(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535.0f));
    bytes.push_back(static_cast<uint8_t>(v >> 8)), bytes.push_back(static_cast<uint8_t>(v & 0xff));
  }
  return bytes;
}

}  // namespace

Result<std::vector<std::byte>> encode_png(int width, int height, std::span<const uint8_t> rgb) {
  if (auto ok = check_size("PNG", width, height, rgb); !ok) return ok.error();
  return in_memory([&](Writer& writer) { return write_picture(writer, width, height, rgb, {}); });
}

Result<std::vector<std::byte>> encode_png(const Image& image) {
  static constexpr int kColorTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                        PNG_COLOR_TYPE_RGB_ALPHA};
  if (image.empty() || image.channels < 1 || image.channels > 4) return output_error("PNG: the picture is empty");
  const bool wide = image.type == PixelType::float32;
  const std::vector<uint8_t> converted = wide ? sixteen_bits(image.floats) : std::vector<uint8_t>();
  const std::vector<uint8_t>& samples = wide ? converted : image.bytes;
  const size_t row = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels) * (wide ? 2 : 1);
  std::vector<png_bytep> rows;
  for (size_t y = 0; y < static_cast<size_t>(image.height); ++y)
    rows.push_back(const_cast<png_bytep>(&samples[y * row]));  // only read from
  const Format format{static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), wide ? 16 : 8,
                      kColorTypes[image.channels - 1], false};
  return in_memory([&](Writer& writer) { return write_chunks(writer, format, rows.data(), nullptr, 0); });
}

Result<void> write_png(const std::filesystem::path& path, int width, int height, std::span<const uint8_t> rgb,
                       const std::map<std::string, std::string>& attributes) {
  if (auto ok = check_size(path.string(), width, height, rgb); !ok) return ok;
  std::vector<png_text> texts;
  for (const auto& [keyword, text] : attributes) {
    if (!is_keyword(keyword))
      return output_error(path.string() + ": '" + keyword + "' cannot be the keyword of a PNG text");
    texts.push_back(text_chunk(keyword, text));
  }
  return write_atomically(path, [&](const std::filesystem::path& temporary) -> Result<void> {
    File file(std::fopen(temporary.c_str(), "wb"), std::fclose);
    if (!file) return output_error(path.string() + ": cannot be written: " + std::strerror(errno));
    Writer writer(file.get());
    if (!write_picture(writer, width, height, rgb, texts))
      return output_error(path.string() + ": cannot be written as PNG: " + writer.message);
    if (std::fclose(file.release()) != 0)
      return output_error(path.string() + ": cannot be written to its end; is the disk full?");
    return {};
  });
}

}  // namespace etendue::image
