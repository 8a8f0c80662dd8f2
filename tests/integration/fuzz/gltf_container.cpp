#include "integration/fuzz/gltf_container.h"

#include <cstring>

#include "base/base64.h"
#include "base/file.h"
#include "integration/fuzz/target.h"

namespace etendue::fuzz {
namespace {

using nlohmann::json;

constexpr size_t kHeader = 12, kChunkHeader = 8;
constexpr size_t kMostEmbedded = size_t{1} << 18;  // bytes of a file

std::string word(size_t value) {
  const auto small = static_cast<uint32_t>(value);
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &small, sizeof small);
  return bytes;
}

// Replaces the URI of a buffer or image by a data URI. Returns false if its file is missing or large.
bool embed(json& object, const std::filesystem::path& folder) {
  if (!object.is_object() || !object.contains("uri") || !object["uri"].is_string()) return true;
  const std::string uri = object["uri"].get<std::string>();
  if (uri.starts_with("data:")) return true;
  std::error_code code;
  const auto size = std::filesystem::file_size(folder / uri, code);
  if (code || size > kMostEmbedded) return false;
  const auto bytes = read_file(folder / uri);
  if (bytes) object["uri"] = "data:application/octet-stream;base64," + base64(*bytes);
  return static_cast<bool>(bytes);
}

}  // namespace

std::optional<Container> split_gltf(const Bytes& file) {
  const std::string_view text = text_of(file);
  Container container;
  container.binary = text.starts_with("glTF");
  size_t first = 0, length = text.size();
  if (container.binary) {
    first = kHeader + kChunkHeader;
    uint32_t declared = 0;
    if (file.size() < first) return {};
    std::memcpy(&declared, file.data() + kHeader, sizeof declared);
    if (declared > file.size() - first) return {};
    length = declared;
    container.rest.assign(file.begin() + static_cast<std::ptrdiff_t>(first + length), file.end());
  }
  container.root = json::parse(text.substr(first, length), nullptr, false);
  if (!container.root.is_structured()) return {};
  return container;
}

Bytes join_gltf(const Container& container) {
  std::string text = container.root.dump(-1, ' ', false, json::error_handler_t::replace);
  if (!container.binary) return bytes_of(text);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const size_t total = kHeader + kChunkHeader + text.size() + container.rest.size();
  Bytes file = bytes_of("glTF" + word(2) + word(total) + word(text.size()) + "JSON" + text);
  file.insert(file.end(), container.rest.begin(), container.rest.end());
  return file;
}

Bytes self_contained(const std::filesystem::path& file) {
  const auto bytes = read_file(file);
  if (!bytes) return {};
  auto container = split_gltf(*bytes);
  if (!container) return *bytes;
  for (const char* array : {"buffers", "images"}) {
    if (!container->root.contains(array) || !container->root[array].is_array()) continue;
    for (json& object : container->root[array])
      if (!embed(object, file.parent_path())) return {};
  }
  return join_gltf(*container);
}

}  // namespace etendue::fuzz
