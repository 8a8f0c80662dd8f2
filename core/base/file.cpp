#include "base/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>

#include "base/provided_files.h"

namespace etendue {
namespace fs = std::filesystem;

namespace {

// The file that a symbolic link leads to; other paths are unchanged.
fs::path followed(const fs::path& path) {
  std::error_code code;
  if (!fs::is_symlink(path, code)) return path;
  const fs::path target = fs::canonical(path, code);
  return code ? path : target;
}

// Whether the path is a device, a pipe or a socket.
bool is_device(const fs::path& path) {
  std::error_code code;
  const auto status = fs::status(path, code);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path temporary_beside(const fs::path& path) {
  return path.parent_path() /
         ("." + path.stem().string() + ".tmp-" + std::to_string(::getpid()) + path.extension().string());
}

}  // namespace

Result<void> check_readable(const fs::path& path) {
  std::error_code code;
  const auto status = fs::status(path, code);
  if (!fs::exists(status)) return input_error(path.string() + ": there is no such file");
  if (fs::is_directory(status)) return input_error(path.string() + ": this is a folder; give a file");
  // Opening a pipe would wait for its other end.
  if (!fs::is_regular_file(status)) return input_error(path.string() + ": this is a device or a pipe; give a file");
  return {};
}

Result<std::vector<std::byte>> read_file(const fs::path& path) {
  if (const auto* provided = provided_file(path)) return *provided;
  if (const auto ok = check_readable(path); !ok) return ok.error();
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return input_error(path.string() + ": cannot be read: " + std::strerror(errno));
  std::error_code code;
  const auto size = fs::file_size(path, code);
  std::vector<std::byte> bytes(code ? 0 : size);
  if (!code && std::fread(bytes.data(), 1, bytes.size(), file.get()) == bytes.size()) {
    note_file_read(path);
    return bytes;
  }
  return input_error(path.string() + ": the file could not be read completely");
}

Result<void> check_writable(const fs::path& path) {
  const fs::path target = followed(path);
  std::error_code code;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code))
    return output_error(path.string() + ": the folder " + folder.string() + " does not exist; create it first");
  if (fs::is_directory(target, code)) return output_error(path.string() + ": this is a folder; give a file name");
  if (is_device(target)) return {};
  const fs::path temporary = temporary_beside(target);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(temporary.c_str(), "wb"), std::fclose);
  if (!file) return output_error(path.string() + ": cannot be written: " + std::strerror(errno));
  fs::remove(temporary, code);
  return {};
}

Result<void> write_atomically(const fs::path& path, const std::function<Result<void>(const fs::path&)>& write) {
  if (auto writable = check_writable(path); !writable) return writable;
  const fs::path target = followed(path);
  if (is_device(target)) return write(target);
  const fs::path temporary = temporary_beside(target);
  std::error_code code;
  auto written = write(temporary);
  if (!written) {
    fs::remove(temporary, code);
    return written;
  }
  fs::rename(temporary, target, code);
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
