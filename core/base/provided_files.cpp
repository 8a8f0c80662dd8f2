#include "base/provided_files.h"

#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

namespace etendue {
namespace {

// Textures are read by several threads.
struct Files {
  std::mutex mutex;
  std::map<std::string, std::vector<std::byte>> provided;
  bool is_recording = false;
  std::set<std::string> read;
};

Files& files() {
  static Files all;
  return all;
}

}  // namespace

void provide_files(std::vector<ProvidedFile> provided) {
  const std::scoped_lock lock(files().mutex);
  for (ProvidedFile& file : provided) files().provided.try_emplace(std::move(file.path), std::move(file.bytes));
}

const std::vector<std::byte>* provided_file(const std::filesystem::path& path) {
  const std::scoped_lock lock(files().mutex);
  const auto found = files().provided.find(path.string());
  return found == files().provided.end() ? nullptr : &found->second;
}

bool is_file(const std::filesystem::path& path) {
  std::error_code code;
  return provided_file(path) || std::filesystem::is_regular_file(path, code);
}

void record_files_read() {
  const std::scoped_lock lock(files().mutex);
  files().is_recording = true;
}

std::vector<std::string> files_read() {
  const std::scoped_lock lock(files().mutex);
  return {files().read.begin(), files().read.end()};
}

void note_file_read(const std::filesystem::path& path) {
  const std::scoped_lock lock(files().mutex);
  if (files().is_recording) files().read.insert(path.string());
}

}  // namespace etendue
