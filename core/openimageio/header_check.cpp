#include "header_check.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>

namespace etendue::openimageio {
namespace {

using Header = std::array<unsigned char, 128>;

uint32_t little_endian(const Header& header, size_t at) {
  return header[at] | header[at + 1] << 8 | header[at + 2] << 16 | static_cast<uint32_t>(header[at + 3]) << 24;
}

// The pixel format begins at byte 76: its size, flags, a FourCC code, the bits per pixel, and the masks of red, green, blue
// and alpha [DirectX documentation, DDS_PIXELFORMAT].
Result<void> check_dds(const Header& header, const std::string& name) {
  constexpr uint32_t kAlpha = 0x1, kRgb = 0x40;
  const uint32_t flags = little_endian(header, 80);
  const auto has_mask = [&](size_t channel) { return little_endian(header, 92 + 4 * channel) != 0; };
  const bool lacks_color = (flags & kRgb) != 0 && !(has_mask(0) && has_mask(1) && has_mask(2));
  const bool lacks_alpha = (flags & kRgb) != 0 && (flags & kAlpha) != 0 && !has_mask(3);
  if (lacks_color || lacks_alpha) return input_error(name + ": the DDS header has no bit mask for a channel");
  return {};
}

// After the header of 26 bytes: colour mode data, image resources, and layers, each after its length. The length of
// layers has eight bytes in version 2 [Adobe Photoshop File Formats Specification].
Result<void> check_psd(std::ifstream& file, uint64_t size, uint16_t version, const std::string& name) {
  uint64_t at = 26;
  for (int section = 0; section < 3; ++section) {
    std::array<unsigned char, 8> bytes{};
    const size_t count = section == 2 && version == 2 ? 8 : 4;
    file.seekg(static_cast<std::streamoff>(at));
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count)))
      return input_error(name + ": the file ends before the image");
    uint64_t length = 0;
    for (const unsigned char byte : std::span(bytes).first(count)) length = length << 8 | byte;
    at += count;
    if (length > size - at) return input_error(name + ": a section of the file is longer than the file");
    at += length;
  }
  return {};
}

}  // namespace

Result<void> check_header(const std::string& path, const std::string& name) {
  std::ifstream file(path, std::ios::binary);
  Header header{};
  file.read(reinterpret_cast<char*>(header.data()), header.size());
  const auto count = static_cast<size_t>(file.gcount());
  file.clear();
  const std::string_view magic(reinterpret_cast<const char*>(header.data()), 4);
  if (magic == "DDS " && count == header.size()) return check_dds(header, name);
  std::error_code code;
  if (magic == "8BPS")
    return check_psd(file, std::filesystem::file_size(path, code), static_cast<uint16_t>(header[4] << 8 | header[5]),
                     name);
  return {};
}

}  // namespace etendue::openimageio
