// Image file formats
//
// A format is one source file (png.cpp, exr.cpp, ...) that defines an ImageFormat, and one entry of the registry in
// format.cpp. Formats that OpenImageIO reads and writes are entries of plugin_formats.cpp. Readers recognise a file by
// its content, writers are selected by the extension.
//
// A reader takes the size of the image from the header and validates it with `check_image_size` and `check_file_length`
// before it allocates memory for the pixels. Damaged files are input errors, never crashes.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "image/image.h"

namespace etendue::image {

using Bytes = std::span<const std::byte>;

struct ImageFormat {
  std::string_view name;   // "png"
  std::string_view label;  // shown to the user: "PNG"
  std::array<std::string_view, 12>
      extensions;        // lower case, with the dot, the usual one first; unused entries are empty
  std::string_view doc;  // what is read and written

  // Whether the first bytes are those of this format.
  bool (*recognises)(Bytes bytes);

  // Readers; `name` is used in messages. A format has one of the two.
  Result<Image> (*decode)(Bytes bytes, const std::string& name) = nullptr;
  Result<LayeredImage> (*decode_layers)(Bytes bytes, const std::string& name) = nullptr;
  // The memory of the decoded pixels according to the header, in bytes; 0 if it is damaged. Null if only decoding tells.
  uint64_t (*decoded_size)(Bytes bytes) = nullptr;
  // Reads a file as linear floats with Rec. 709 primaries, for formats that declare their colour space or have more
  // than 8 bits; null for others.
  Result<Image> (*read_linear)(const std::filesystem::path& path, const ImageFormat& format) = nullptr;

  // Writers; a format has at most one, according to what it stores: all layers and attributes; linear RGB; or
  // display-encoded 8-bit RGB with text attributes. Arguments as for write_exr, write_hdr and write_png.
  Result<void> (*write_layers)(const std::filesystem::path& path, const LayeredImage& image) = nullptr;
  Result<void> (*write_linear)(const std::filesystem::path& path, int width, int height,
                               std::span<const float> rgb) = nullptr;
  Result<void> (*write_display)(const std::filesystem::path& path, int width, int height, std::span<const uint8_t> rgb,
                                const std::map<std::string, std::string>& attributes) = nullptr;

  // Whether OpenImageIO is needed (image/plugin.h).
  bool reads_by_plugin = false, writes_by_plugin = false;

  bool can_write() const { return write_layers || write_linear || write_display; }
};

// All formats.
std::span<const ImageFormat* const> image_formats();

// The labels of all formats that are read: "PNG, JPEG or WebP".
std::string readable_formats();
// Their extensions, in lower case with the dot.
std::vector<std::string> readable_extensions();

// The format of this content, or null.
const ImageFormat* recognise_format(Bytes bytes);

// The format that writes files with the extension of `path` (case-insensitive), or null.
const ImageFormat* find_writer(const std::filesystem::path& path);

// The same, as a result: the error lists the extensions that are written, or says what to install for this one.
Result<const ImageFormat*> require_writer(const std::filesystem::path& path);

// ---- For readers and writers

inline constexpr uint64_t kMaxPixels = uint64_t{1} << 28;

// An error if the image has no pixels, or more than kMaxPixels.
Result<void> check_image_size(uint64_t width, uint64_t height, const std::string& name);

// An error if a file is shorter than the `required` bytes that the image in its header takes at least.
Result<void> check_file_length(uint64_t required, Bytes bytes, const std::string& name);

// An error unless `samples` are the components of a non-empty RGB image of this size.
Result<void> check_rgb_size(int width, int height, size_t samples, const std::string& name);

bool starts_with(Bytes bytes, std::string_view prefix);

// An 8-bit image with allocated pixels; the size must have been checked.
Image make_byte_image(int width, int height, int channels);

// The error for a file that could be opened but not written completely.
Error incomplete_write(const std::filesystem::path& path);

}  // namespace etendue::image
