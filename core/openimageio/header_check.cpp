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

uint64_t big_endian(std::span<const unsigned char> bytes) {
  uint64_t value = 0;
  for (const unsigned char byte : bytes) value = value << 8 | byte;
  return value;
}

Error section_error(const std::string& name) {
  return input_error(name + ": a section of the file is longer than the file");
}

// Byte 32 begins the size of the user data, in the byte order of the magic number; all bits are set if it is undefined
// [SMPTE ST 268-1].
Result<void> check_dpx(const Header& header, uint64_t size, const std::string& name) {
  const uint64_t user_data =
      header[0] == 'X' ? little_endian(header, 32) : big_endian(std::span(header).subspan(32, 4));
  if (user_data != UINT32_MAX && user_data > size) return section_error(name);
  return {};
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
    const uint64_t length = big_endian(std::span(bytes).first(count));
    at += count;
    if (length > size - at) return section_error(name);
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
  const uint64_t size = std::filesystem::file_size(path, code);
  if (magic == "SDPX" || magic == "XPDS") return check_dpx(header, size, name);
  if (magic == "8BPS") return check_psd(file, size, static_cast<uint16_t>(header[4] << 8 | header[5]), name);
  return {};
}

}  // namespace etendue::openimageio
