#include "medium/grid_file.h"

#include <filesystem>
#include <map>
#include <mutex>

#include "medium/nanovdb_reader.h"

namespace etendue {
namespace {

struct LoadedFile {
  std::filesystem::file_time_type changed;
  std::weak_ptr<const GridValues> values;
};

}  // namespace

Result<std::shared_ptr<const GridValues>> load_grid_file(const std::string& path) {
  static std::mutex mutex;
  static std::map<std::string, LoadedFile> loaded;
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(path, error);
  if (error) return input_error(path + ": cannot be read: " + error.message() + "; give the path of a .nvdb file");
  const std::lock_guard lock(mutex);
  LoadedFile& entry = loaded[path];
  if (auto values = entry.values.lock(); values && entry.changed == changed) return values;
  auto read = read_nanovdb(path);
  if (!read) return read.error();
  std::shared_ptr<const GridValues> values = std::make_shared<GridValues>(std::move(*read));
  entry = {changed, values};
  return values;
}

}  // namespace etendue
