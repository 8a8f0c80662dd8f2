// The snapshots of a folder: what their files say about them, read in the background.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

// Text of the user in an OpenEXR file; other programs show this attribute as well.
inline constexpr const char* kNotesAttribute = "comments";

struct SnapshotInfo {
  std::string file;
  std::filesystem::file_time_type time{};  // of the last change
  std::string date{};                      // the same as text
  int width = 0, height = 0;
  std::string state{};       // render::state_json
  std::string integrator{};  // its label
  uint32_t samples = 0;
  std::string notes{};
  uint64_t bytes = 0;
  uint64_t checkpoint_bytes = 0;  // of the file with the samples; 0: there is none
};

class SnapshotList final : public Task {
 public:
  // Reads the folder if it is another one or has changed. Files that have not changed are not read again.
  void update(const TaskContext& context, const std::filesystem::path& folder);
  // Replaces the notes of a file.
  void write_notes(const TaskContext& context, const std::string& file, const std::string& notes);
  // Newest first.
  const std::vector<SnapshotInfo>& all() const { return snapshots_; }
  // Counts the changes of the list.
  uint64_t revision() const { return revision_; }
  // Whether the list has the present content of this folder.
  bool is_current(const std::filesystem::path& folder) const;
  bool is_reading() const { return reading_.running(); }

  void reset(const TaskContext&) override {}
  bool has_update() const override { return reading_.has_result() || writing_.has_result(); }
  bool is_saving() const override { return writing_.running(); }

 private:
  BackgroundTask<std::vector<SnapshotInfo>> reading_;
  BackgroundTask<Result<void>> writing_;
  std::filesystem::path folder_;
  std::filesystem::file_time_type folder_time_{};  // of the last change that was read
  std::vector<SnapshotInfo> snapshots_;
  uint64_t revision_ = 0;
};

// Removes the file and the checkpoint beside it. Returns what went wrong; empty if nothing did.
std::string remove_snapshot(const std::string& file);

}  // namespace etendue::viewer
