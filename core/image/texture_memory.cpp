#include "image/texture_memory.h"

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "base/user_folders.h"
#include "base/file.h"
#include "base/hash.h"
#include "image/plugin.h"

namespace etendue::image {
namespace {

namespace fs = std::filesystem;

// Increase it when the content of stored files changes.
constexpr uint64_t kStoreVersion = 1;

std::atomic<uint64_t> budget{kUnlimitedTextureMemory};

uint64_t hash_of(Bytes bytes, bool srgb) {
  uint64_t hash = mix_bits(bytes.size() * 4 + (srgb ? 1 : 0) + (kStoreVersion << 48));
  while (bytes.size() >= sizeof(uint64_t)) {
    uint64_t word;
    std::memcpy(&word, bytes.data(), sizeof word);
    hash = mix_bits(hash ^ word) + 0x9e3779b97f4a7c15ULL;
    bytes = bytes.subspan(sizeof word);
  }
  return hash_bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size(), hash);
}

Result<fs::path> store_folder() {
  const fs::path cache = cache_folder();
  if (cache.empty())
    return output_error("there is no folder for converted textures; set the environment variable XDG_CACHE_HOME");
  const fs::path folder = cache / "textures";
  std::error_code code;
  fs::create_directories(folder, code);
  if (!fs::is_directory(folder)) return output_error(folder.string() + ": cannot be created: " + code.message());
  return folder;
}

Result<void> convert(const ImagePlugin& plugin, Bytes bytes, const std::string& name, bool srgb, const fs::path& file) {
  const auto image = decode_image(bytes, name);
  if (!image) return image.error();
  return write_atomically(
      file, [&](const fs::path& temporary) { return plugin.write_tiles(*image, srgb, temporary.string()); });
}

}  // namespace

void set_texture_memory(uint64_t bytes) { budget = bytes; }
uint64_t texture_memory() { return budget; }

Result<uint64_t> parse_memory_size(const std::string& text) {
  double number = 0;
  char unit = 0, rest = 0;
  const int read = std::sscanf(text.c_str(), "%lf%c%c", &number, &unit, &rest);
  static constexpr std::string_view kUnits = "KMGT", kLowerCase = "kmgt";
  double factor = 1;
  bool known = read == 1;
  for (size_t i = 0; read == 2 && i < kUnits.size(); ++i)
    if (unit == kUnits[i] || unit == kLowerCase[i]) {
      factor = std::ldexp(1.0, 10 * static_cast<int>(i + 1));
      known = true;
    }
  if (!known || !(number * factor >= 1 && number * factor < 0x1p60))
    return usage_error("'" + text + "' is not a size of memory; give a positive number of bytes, or one with K, M, G " +
                       "or T, for example 512M or 1.5G");
  return static_cast<uint64_t>(number * factor);
}

uint64_t decoded_size(std::span<const std::byte> bytes, const std::string& name) {
  if (const ImageFormat* format = recognise_format(bytes); format && format->decoded_size)
    return format->decoded_size(bytes);
  const auto image = decode_image(bytes, name);
  return image ? image->memory() : 0;
}

Result<std::shared_ptr<const TiledImage>> stored_tiles(std::span<const std::byte> bytes, const std::string& name,
                                                       bool srgb) {
  const auto failed = [&](const Error& error) { return Error{error.fault, name + ": " + error.message}; };
  const auto plugin = image_plugin();
  if (!plugin) return failed(plugin.error());
  const auto folder = store_folder();
  if (!folder) return failed(folder.error());
  const uint64_t hash = hash_of(bytes, srgb);
  char text[24];
  std::snprintf(text, sizeof text, "%016llx.tx", static_cast<unsigned long long>(hash));
  const fs::path file = *folder / text;
  static std::mutex conversions;
  const std::lock_guard lock(conversions);
  (*plugin)->set_tile_memory(texture_memory());
  if (auto tiles = (*plugin)->open_tiles(file.string(), hash)) return tiles;
  if (auto converted = convert(**plugin, bytes, name, srgb, file); !converted) return converted.error();
  auto tiles = (*plugin)->open_tiles(file.string(), hash);
  if (!tiles) return failed(tiles.error());
  return tiles;
}

}  // namespace etendue::image
