// Writing 8-bit sRGB PNG with text chunks.
#include <png.h>

#include <algorithm>
#include <cerrno>
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

bool write_chunks(Writer& writer, png_uint_32 width, png_uint_32 height, png_bytepp rows, png_const_textp texts,
                  int text_count) {
  writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, on_error, on_warning);
  if (writer.png) writer.info = png_create_info_struct(writer.png);
  if (!writer.info) return false;
  if (setjmp(png_jmpbuf(writer.png))) return false;
  png_init_io(writer.png, writer.file);
  png_set_user_limits(writer.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(writer.png, writer.info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_text(writer.png, writer.info, texts, text_count);
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
  return write_chunks(writer, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), rows.data(),
                      texts.data(), static_cast<int>(texts.size()));
}

Result<void> check_size(const std::string& name, int width, int height, std::span<const uint8_t> rgb) {
  const size_t w = static_cast<size_t>(std::max(width, 0)), h = static_cast<size_t>(std::max(height, 0));
  if (!rgb.empty() && rgb.size() == w * h * 3) return {};
  return output_error(name + ": the pixels do not fill " + std::to_string(width) + " x " + std::to_string(height) +
                      " RGB");
}

}  // namespace

Result<std::vector<std::byte>> encode_png(int width, int height, std::span<const uint8_t> rgb) {
  if (auto ok = check_size("PNG", width, height, rgb); !ok) return ok.error();
  char* bytes = nullptr;
  size_t size = 0;
  File file(open_memstream(&bytes, &size), std::fclose);
  if (!file) return output_error("PNG: not enough memory");
  Writer writer(file.get());
  const bool written = write_picture(writer, width, height, rgb, {});
  file.reset();  // only now are bytes and size those of the whole
  const std::unique_ptr<char, void (*)(void*)> owner(bytes, std::free);
  if (!written) return output_error(std::string("PNG: ") + writer.message);
  const auto* first = reinterpret_cast<const std::byte*>(bytes);
  return std::vector<std::byte>(first, first + size);
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
