#include "base/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>

namespace etendue {
namespace fs = std::filesystem;

Result<std::vector<std::byte>> read_file(const fs::path& path) {
  std::error_code code;
  const auto status = fs::status(path, code);
  if (!fs::exists(status)) return input_error(path.string() + ": there is no such file");
  if (fs::is_directory(status)) return input_error(path.string() + ": this is a folder; give a file");

  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return input_error(path.string() + ": cannot be read: " + std::strerror(errno));
  const auto size = fs::file_size(path, code);
  std::vector<std::byte> bytes(code ? 0 : size);
  if (!code && std::fread(bytes.data(), 1, bytes.size(), file.get()) == bytes.size()) return bytes;
  return input_error(path.string() + ": the file could not be read completely");
}

Result<void> write_atomically(const fs::path& path, const std::function<Result<void>(const fs::path&)>& write) {
  std::error_code code;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code))
    return output_error(path.string() + ": the folder " + folder.string() + " does not exist");
  if (fs::is_directory(path, code)) return output_error(path.string() + ": this is a folder; give a file name");

  const fs::path temporary =
      folder / ("." + path.stem().string() + ".tmp-" + std::to_string(::getpid()) + path.extension().string());
  auto written = write(temporary);
  if (!written) {
    fs::remove(temporary, code);
    return written;
  }
  fs::rename(temporary, path, code);
  if (code) {
    const std::string reason = code.message();
    fs::remove(temporary, code);
    return output_error(path.string() + ": cannot be written: " + reason);
  }
  return {};
}

Result<void> write_file(const fs::path& path, const void* data, size_t size) {
  return write_atomically(path, [&](const fs::path& temporary) -> Result<void> {
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file) return output_error(path.string() + ": cannot be written: " + std::strerror(errno));
    const bool complete = std::fwrite(data, 1, size, file) == size;
    const bool closed = std::fclose(file) == 0;
    if (complete && closed) return {};
    return output_error(path.string() + ": could not be written completely; is the disk full?");
  });
}

}  // namespace etendue
