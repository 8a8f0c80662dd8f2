#include "image/plugin_io.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/file.h"
#include "base/provided_files.h"
#include "image/format.h"
#include "image/plugin.h"

namespace etendue::image {
namespace {

namespace fs = std::filesystem;

// A file in memory that can be opened by its path.
class MemoryFile {
 public:
  explicit MemoryFile(Bytes bytes) : descriptor_(memfd_create("image", MFD_CLOEXEC)) {
    while (descriptor_ >= 0 && !bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written <= 0) return;
      bytes = bytes.subspan(static_cast<size_t>(written));
    }
    complete_ = descriptor_ >= 0;
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  bool complete() const { return complete_; }
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
  bool complete_ = false;
};

Error with_name(const std::string& name, const Error& error) { return {error.fault, name + ": " + error.message}; }

// PluginRead::format of a recognised format, or nothing for null.
std::string reader_of(const ImageFormat* format) {
  return format ? std::string(format->extensions.front().substr(1)) : "";
}

Result<void> write_by_plugin(const fs::path& path, PluginWrite request) {
  const auto plugin = image_plugin();
  if (!plugin) return output_error(path.string() + ": " + plugin.error().message);
  request.name = path.string();
  return write_atomically(path, [&](const fs::path& temporary) {
    request.path = temporary.string();
    return (*plugin)->write(request);
  });
}

}  // namespace

Result<Image> decode_by_plugin(std::span<const std::byte> bytes, const std::string& name) {
  const auto plugin = image_plugin();
  if (!plugin) return with_name(name, plugin.error());
  const MemoryFile file(bytes);
  if (!file.complete()) return input_error(name + ": not enough memory: " + std::strerror(errno));
  return (*plugin)->read({.path = file.path(),
                          .name = name,
                          .format = reader_of(recognise_format(bytes)),
                          .values = PluginValues::texture,
                          .check_size = check_image_size});
}

Result<Image> read_linear_by_plugin(const fs::path& path, const ImageFormat& format) {
  const auto plugin = image_plugin();
  if (!plugin) return with_name(path.string(), plugin.error());
  const auto* provided = provided_file(path);
  const MemoryFile file(provided ? Bytes(*provided) : Bytes());
  return (*plugin)->read({.path = provided ? file.path() : path.string(),
                          .name = path.string(),
                          .format = reader_of(&format),
                          .values = PluginValues::linear,
                          .check_size = check_image_size});
}

Result<void> write_linear_by_plugin(const fs::path& path, int width, int height, std::span<const float> rgb) {
  if (auto size = check_rgb_size(width, height, rgb.size(), path.string()); !size) return size;
  return write_by_plugin(path, {.width = width, .height = height, .linear = rgb});
}

Result<void> write_display_by_plugin(const fs::path& path, int width, int height, std::span<const uint8_t> rgb,
                                     const std::map<std::string, std::string>&) {
  if (auto size = check_rgb_size(width, height, rgb.size(), path.string()); !size) return size;
  return write_by_plugin(path, {.width = width, .height = height, .display = rgb});
}

}  // namespace etendue::image
