#include "medium/grid_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>

#include "base/file.h"
#include "base/provided_files.h"
#include "medium/grid_plugin.h"
#include "medium/nanovdb_reader.h"

namespace etendue {
namespace {

struct LoadedFile {
  std::filesystem::file_time_type changed;
  std::weak_ptr<const GridValues> values;
};

Result<GridValues> parse_vdb(std::span<const std::byte> bytes, const std::string& name) {
  const auto plugin = grid_plugin();
  if (!plugin) return input_error(name + ": " + plugin.error().message);
  return (*plugin)->read_vdb(bytes, name, kMostGridVoxels);
}

void remove_invalid(std::vector<float>& values) {
  for (float& v : values)
    if (!(v > 0) || !std::isfinite(v)) v = 0;
}

}  // namespace

Result<GridValues> parse_grid_file(std::span<const std::byte> bytes, const std::string& name) {
  auto values = name.ends_with(".vdb") ? parse_vdb(bytes, name) : parse_nanovdb(bytes, name, kMostGridVoxels);
  if (!values) return values;
  remove_invalid(values->density);
  remove_invalid(values->temperature);
  float highest = 0;
  for (const float t : values->temperature) highest = std::max(highest, t);
  for (float& t : values->temperature) t = highest > 0 ? t / highest : 0;
  return values;
}

Result<std::shared_ptr<const GridValues>> load_grid_file(const std::string& path) {
  static std::mutex mutex;
  static std::map<std::string, LoadedFile> loaded;
  std::error_code error;
  std::filesystem::file_time_type changed;
  if (!provided_file(path)) changed = std::filesystem::last_write_time(path, error);
  if (error)
    return input_error(path + ": cannot be read: " + error.message() + "; give the path of a .nvdb or .vdb file");
  const std::lock_guard lock(mutex);
  LoadedFile& entry = loaded[path];
  if (auto values = entry.values.lock(); values && entry.changed == changed) return values;
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  auto read = parse_grid_file(*bytes, path);
  if (!read) return read.error();
  std::shared_ptr<const GridValues> values = std::make_shared<GridValues>(std::move(*read));
  entry = {changed, values};
  return values;
}

}  // namespace etendue
