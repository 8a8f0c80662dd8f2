#include "image/exr_attributes.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

namespace etendue::image {
namespace {

constexpr uint32_t kMultiPart = 0x1000;
constexpr size_t kLongestText = 255;

// The length in bytes of attribute types that have one.
constexpr std::pair<std::string_view, uint32_t> kFixedLengths[] = {
    {"box2f", 16},   {"box2i", 16},  {"chromaticities", 32}, {"compression", 1}, {"deepImageState", 1}, {"double", 8},
    {"envmap", 1},   {"float", 4},   {"int", 4},             {"keycode", 28},    {"lineOrder", 1},      {"m33d", 72},
    {"m33f", 36},    {"m44d", 128},  {"m44f", 64},           {"rational", 8},    {"tiledesc", 9},       {"timecode", 8},
    {"v2d", 16},     {"v2f", 8},     {"v2i", 8},             {"v3d", 24},        {"v3f", 12},           {"v3i", 12}};

// Reads from the start to the end; after a failed read, `failed` stays true.
class Reader {
 public:
  explicit Reader(Bytes bytes) : bytes_(bytes) {}

  bool failed() const { return failed_; }
  Bytes rest() const { return bytes_; }

  // Whether the next byte is 0, which is then skipped.
  bool skip_zero() {
    if (bytes_.empty() || bytes_[0] != std::byte{0}) return false;
    bytes_ = bytes_.subspan(1);
    return true;
  }
  uint32_t number() {
    uint32_t value = 0;
    if (const Bytes taken = take(sizeof value); !failed_) std::memcpy(&value, taken.data(), sizeof value);
    return value;
  }
  // A text that ends with 0.
  std::string_view text() {
    const auto end = std::ranges::find(bytes_.first(std::min(bytes_.size(), kLongestText + 1)), std::byte{0});
    const auto length = static_cast<size_t>(end - bytes_.begin());
    const Bytes taken = take(length + 1);
    return failed_ ? std::string_view{} : std::string_view(reinterpret_cast<const char*>(taken.data()), length);
  }
  Bytes take(size_t size) {
    failed_ = failed_ || size > bytes_.size();
    if (failed_) return {};
    const Bytes taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }

 private:
  Bytes bytes_;
  bool failed_ = false;
};

// The length of a list of channels, which ends with an empty name.
std::optional<size_t> length_of_channels(Bytes value) {
  constexpr size_t kChannel = 16;  // bytes after the name
  Reader reader(value);
  while (!reader.failed() && !reader.skip_zero()) {
    reader.text();
    reader.take(kChannel);
  }
  if (reader.failed()) return {};
  return value.size() - reader.rest().size();
}

// A width, a height, and four bytes per pixel.
std::optional<size_t> length_of_preview(Bytes value) {
  Reader reader(value);
  const uint64_t width = reader.number(), height = reader.number();
  if (reader.failed()) return {};
  return 8 + 4 * width * height;
}

bool has_length_of_type(std::string_view type, Bytes value) {
  if (type == "chlist") return length_of_channels(value) == value.size();
  if (type == "preview") return length_of_preview(value) == value.size();
  const auto* fixed = std::ranges::find(kFixedLengths, type, [](const auto& entry) { return entry.first; });
  return fixed == std::end(kFixedLengths) || value.size() == fixed->second;
}

Error damaged(const std::string& name, std::string_view attribute, const std::string& reason) {
  return input_error(name + ": the attribute '" + std::string(attribute) + "' of the OpenEXR file " + reason +
                     "; the file is truncated or damaged");
}

}  // namespace

Result<void> check_exr_attributes(Bytes bytes, const std::string& name) {
  Reader reader(bytes);
  reader.number();
  const bool has_parts = (reader.number() & kMultiPart) != 0;
  while (!reader.failed()) {
    if (reader.skip_zero()) {
      // The end of a header. After the last one of several parts follows an empty header.
      if (!has_parts || reader.skip_zero()) return {};
    }
    const std::string_view attribute = reader.text(), type = reader.text();
    const uint32_t size = reader.number();
    const Bytes value = reader.take(size);
    if (reader.failed()) return damaged(name, attribute, "is longer than the rest of the file");
    if (!has_length_of_type(type, value))
      return damaged(name, attribute, "does not have the length of its type, '" + std::string(type) + "'");
  }
  return input_error(name + ": the OpenEXR file has no header; it is truncated");
}

}  // namespace etendue::image
