#include "viewer/files/snapshot_list.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "image/image.h"
#include "render/checkpoint.h"
#include "render/document.h"
#include "render/image_output.h"
#include "render/state_difference.h"
#include "viewer/files/file_names.h"
#include "viewer/state/document_info.h"
#include "viewer/state/notices.h"

namespace etendue::viewer {
namespace {

namespace fs = std::filesystem;

std::string date_of(fs::file_time_type time) {
  const auto since_1970 = std::chrono::file_clock::to_sys(time).time_since_epoch();
  return date_text(std::chrono::duration_cast<std::chrono::seconds>(since_1970).count());
}

// The label of the integrator of a state, also of one that was chosen automatically.
std::string integrator_of(const std::string& state) {
  const auto json = nlohmann::json::parse(state, nullptr, false);
  const auto text = [&](const char* object, const char* name, const std::string& otherwise) {
    const auto members = json.is_object() ? json.find(object) : json.end();
    if (members == json.end() || !members->is_object()) return otherwise;
    const auto member = members->find(name);
    return member != members->end() && member->is_string() ? member->get<std::string>() : otherwise;
  };
  const std::string name = text("settings", "render.integrator", render::MethodSettings{}.integrator);
  return integrator_label(name == render::kAutomatic ? text("automatic", "integrator", name) : name);
}

uint64_t size_of(const fs::path& file) {
  std::error_code code;
  const auto bytes = fs::file_size(file, code);
  return code ? 0 : bytes;
}

// An empty state for files that are not snapshots.
SnapshotInfo read_info(const std::string& file, fs::file_time_type time) {
  SnapshotInfo info{.file = file, .time = time, .date = date_of(time)};
  const auto header = image::read_exr_header(file);
  if (!header) return info;
  const auto text = [&](const char* attribute) {
    const auto found = header->attributes.find(attribute);
    return found == header->attributes.end() ? std::string() : found->second;
  };
  info.width = header->width;
  info.height = header->height;
  info.state = text(render::kStateAttribute);
  info.notes = text(kNotesAttribute);
  info.integrator = integrator_of(info.state);
  info.samples = render::samples_of_state(info.state);
  info.bytes = size_of(file);
  return info;
}

std::vector<SnapshotInfo> read_folder(const fs::path& folder, const std::vector<SnapshotInfo>& known) {
  std::vector<SnapshotInfo> snapshots;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code); !code && entry != fs::directory_iterator(); entry.increment(code)) {
    const std::string file = entry->path().string();
    if (lower_extension(file) != ".exr") continue;
    const auto time = fs::last_write_time(entry->path(), code);
    if (code) break;
    const auto same = std::ranges::find_if(known, [&](const auto& s) { return s.file == file && s.time == time; });
    SnapshotInfo info = same != known.end() ? *same : read_info(file, time);
    info.checkpoint_bytes = size_of(render::checkpoint_of_image(file));
    if (!info.state.empty()) snapshots.push_back(std::move(info));
  }
  std::ranges::sort(snapshots, [](const auto& a, const auto& b) {
    return a.time != b.time ? a.time > b.time : a.file > b.file;
  });
  return snapshots;
}

}  // namespace

void SnapshotList::update(const TaskContext& context, const fs::path& folder) {
  if (const auto written = writing_.take_result())
    if (!*written) context.notices.add_error(written->error().message);
  if (auto read = reading_.take_result()) {
    snapshots_ = std::move(*read);
    ++revision_;
  }
  if (is_reading() || is_current(folder)) return;
  std::error_code code;
  folder_ = folder;
  folder_time_ = fs::last_write_time(folder, code);
  reading_.start([folder, known = snapshots_] { return read_folder(folder, known); }, context.wake);
}

bool SnapshotList::is_current(const fs::path& folder) const {
  std::error_code code;
  return folder == folder_ && fs::last_write_time(folder, code) == folder_time_;
}

void SnapshotList::write_notes(const TaskContext& context, const std::string& file, const std::string& notes) {
  writing_.start([file, notes] { return image::set_exr_attribute(file, kNotesAttribute, notes); }, context.wake);
}

std::string remove_snapshot(const std::string& file) {
  std::error_code code;
  fs::remove(file, code);
  if (code) return file + ": cannot be deleted: " + code.message();
  fs::remove(render::checkpoint_of_image(file), code);
  if (code) return render::checkpoint_of_image(file) + ": cannot be deleted: " + code.message();
  return "";
}

}  // namespace etendue::viewer
