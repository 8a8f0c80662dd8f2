// Image files assembled byte by byte from the format specifications.
//
// They share no code with the readers and writers under test, and can contain what no writer produces.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace etendue::test {

using FileBytes = std::string;

inline std::span<const std::byte> view(const FileBytes& file) { return std::as_bytes(std::span(file)); }

// The name of a file in a temporary folder; the destructor removes the folder.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : folder_(std::filesystem::temp_directory_path() / ("etendue-image-" + std::to_string(unique_number()))),
        path_(folder_ / name) {
    std::filesystem::create_directories(folder_);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code code;
    std::filesystem::remove_all(folder_, code);
  }
  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  // Tests run in parallel processes, which are distinguished by the time and an address on the stack.
  static uint64_t unique_number() {
    static uint64_t count = 0;
    const auto now = std::filesystem::file_time_type::clock::now().time_since_epoch().count();
    return static_cast<uint64_t>(now) * 31 + reinterpret_cast<uintptr_t>(&now) + count++;
  }
  std::filesystem::path folder_, path_;
};

template <class T>
void append_little_endian(FileBytes& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

inline void append_big_endian(FileBytes& out, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(value >> shift));
}

// ---- PNG (W3C recommendation, 2nd edition)

inline uint32_t crc32(const FileBytes& data) {
  uint32_t crc = ~0U;
  for (const char c : data) {
    crc ^= static_cast<uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xedb88320U : 0U);
  }
  return ~crc;
}

inline FileBytes png_chunk(const std::string& type, const FileBytes& data) {
  FileBytes out;
  append_big_endian(out, static_cast<uint32_t>(data.size()));
  out += type + data;
  append_big_endian(out, crc32(type + data));
  return out;
}

// A zlib stream with one stored block of up to 65535 bytes.
inline FileBytes zlib_stored(const FileBytes& data) {
  FileBytes out("\x78\x01\x01", 3);
  append_little_endian(out, static_cast<uint16_t>(data.size()));
  append_little_endian(out, static_cast<uint16_t>(~data.size()));
  out += data;
  uint32_t a = 1, b = 0;
  for (const char c : data) {
    a = (a + static_cast<uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  append_big_endian(out, b << 16 | a);
  return out;
}

enum PngColour : char { kGrey = 0, kTrueColour = 2, kPalette = 3, kGreyAlpha = 4, kTrueColourAlpha = 6 };

inline FileBytes png_header(uint32_t width, uint32_t height, int depth, PngColour colour) {
  FileBytes header;
  append_big_endian(header, width);
  append_big_endian(header, height);
  header += {static_cast<char>(depth), colour, 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header);
}

// `rows` holds the raw bytes of each row, `extra` chunks between the header and the data.
inline FileBytes png_file(uint32_t width, int depth, PngColour colour, const std::vector<FileBytes>& rows,
                          const FileBytes& extra = "") {
  FileBytes raw;
  for (const FileBytes& row : rows) raw += '\0' + row;
  return png_header(width, static_cast<uint32_t>(rows.size()), depth, colour) + extra +
         png_chunk("IDAT", zlib_stored(raw)) + png_chunk("IEND", "");
}

// ---- OpenEXR (technical introduction, "File layout"), one part of uncompressed scanlines

struct ExrBox {
  int32_t x0, y0, x1, y1;
};

enum class ExrType : int32_t { uint32 = 0, half = 1, float32 = 2 };

// A channel with the bytes of its samples.
struct ExrChannel {
  std::string name;
  ExrType type;
  std::vector<FileBytes> samples;  // one per pixel of the data window, row by row
};

inline FileBytes exr_attribute(const std::string& name, const std::string& type, const FileBytes& value) {
  FileBytes out = name + '\0' + type + '\0';
  append_little_endian(out, static_cast<int32_t>(value.size()));
  return out + value;
}

inline FileBytes exr_box(const ExrBox& box) {
  FileBytes out;
  for (const int32_t v : {box.x0, box.y0, box.x1, box.y1}) append_little_endian(out, v);
  return out;
}

inline FileBytes exr_header(const std::vector<ExrChannel>& channels, const ExrBox& data, const ExrBox& display) {
  FileBytes list, zero, one;
  for (const ExrChannel& c : channels) {
    list += c.name + '\0';
    for (const int32_t v : {static_cast<int32_t>(c.type), 0, 1, 1}) append_little_endian(list, v);
  }
  append_little_endian(zero, 0.0f);
  append_little_endian(one, 1.0f);
  return FileBytes("\x76\x2f\x31\x01\x02\0\0\0", 8) + exr_attribute("channels", "chlist", list + '\0') +
         exr_attribute("compression", "compression", FileBytes(1, '\0')) +
         exr_attribute("dataWindow", "box2i", exr_box(data)) +
         exr_attribute("displayWindow", "box2i", exr_box(display)) +
         exr_attribute("lineOrder", "lineOrder", FileBytes(1, '\0')) +
         exr_attribute("note", "string", "from the specification") + exr_attribute("pixelAspectRatio", "float", one) +
         exr_attribute("screenWindowCenter", "v2f", zero + zero) + exr_attribute("screenWindowWidth", "float", one) +
         '\0';
}

// Channels must be sorted by name, as the format requires.
inline FileBytes exr_file(const std::vector<ExrChannel>& channels, const ExrBox& data, const ExrBox& display) {
  FileBytes out = exr_header(channels, data, display);
  const size_t width = static_cast<size_t>(data.x1 - data.x0 + 1), height = static_cast<size_t>(data.y1 - data.y0 + 1);
  std::vector<FileBytes> lines;
  for (size_t y = 0; y < height; ++y) {
    FileBytes line, chunk;
    for (const ExrChannel& c : channels)
      for (size_t x = 0; x < width; ++x) line += c.samples[y * width + x];
    append_little_endian(chunk, data.y0 + static_cast<int32_t>(y));
    append_little_endian(chunk, static_cast<int32_t>(line.size()));
    lines.push_back(chunk + line);
  }
  uint64_t offset = out.size() + 8 * height;
  for (const FileBytes& line : lines) {
    append_little_endian(out, offset);
    offset += line.size();
  }
  for (const FileBytes& line : lines) out += line;
  return out;
}

// ---- TIFF (revision 6.0), one image directory

enum class TiffType : uint16_t { byte = 1, ascii = 2, uint16 = 3, uint32 = 4, rational = 5, signed_rational = 10 };

struct TiffTag {
  uint16_t number;
  TiffType type;
  uint32_t count;
  FileBytes values;
};

template <class T>
TiffTag tiff_tag(uint16_t number, TiffType type, const std::vector<T>& values) {
  const bool is_fraction = type == TiffType::rational || type == TiffType::signed_rational;
  TiffTag tag{number, type, static_cast<uint32_t>(is_fraction ? values.size() / 2 : values.size()), {}};
  for (const T value : values) append_little_endian(tag.values, value);
  return tag;
}

// Tags must be sorted by number. The pixels are one strip, whose offset (tag 273) is added.
inline FileBytes tiff_file(std::vector<TiffTag> tags, const FileBytes& pixels) {
  constexpr uint16_t kStripOffsets = 273;
  const auto offsets =
      std::find_if(tags.begin(), tags.end(), [](const TiffTag& tag) { return tag.number > kStripOffsets; }) -
      tags.begin();
  tags.insert(tags.begin() + offsets, tiff_tag<uint32_t>(kStripOffsets, TiffType::uint32, {0}));
  const auto start = static_cast<uint32_t>(8 + 2 + 12 * tags.size() + 4);
  uint32_t length = 0;
  const auto padded = [](size_t size) { return static_cast<uint32_t>(size + size % 2); };
  for (const TiffTag& tag : tags)
    if (tag.values.size() > 4) length += padded(tag.values.size());
  tags[static_cast<size_t>(offsets)] = tiff_tag<uint32_t>(kStripOffsets, TiffType::uint32, {start + length});
  FileBytes out("II\x2a\0\x08\0\0\0", 8), data;
  append_little_endian(out, static_cast<uint16_t>(tags.size()));
  for (const TiffTag& tag : tags) {
    append_little_endian(out, tag.number);
    append_little_endian(out, static_cast<uint16_t>(tag.type));
    append_little_endian(out, tag.count);
    FileBytes values = tag.values;
    if (values.size() <= 4) {
      values.resize(4);
      out += values;
      continue;
    }
    append_little_endian(out, static_cast<uint32_t>(start + data.size()));
    values.resize(padded(values.size()));
    data += values;
  }
  append_little_endian(out, uint32_t{0});
  return out + data + pixels;
}

// The bytes of one sample.
template <class T>
FileBytes sample(T value) {
  FileBytes out;
  append_little_endian(out, value);
  return out;
}

}  // namespace etendue::test
