// The journal of unsaved changes, from which they are recovered after a crash.
//
// Each running viewer writes the state of its document to a session file of its own and holds a lock beside it. A
// journal without a lock was left by a viewer that ended unexpectedly.
#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

class Editor;

// A journal that another viewer left.
struct LostSession {
  std::filesystem::path file;
  std::string scene;      // file or name of the scene, for display
  std::string last_edit;  // local date and time of the last change
};

class EditJournal {
 public:
  // Nothing is written if `folder` is empty or cannot be written.
  explicit EditJournal(const std::filesystem::path& folder);
  // Removes the journal. A viewer that ends normally leaves none.
  ~EditJournal();
  EditJournal(const EditJournal&) = delete;
  EditJournal& operator=(const EditJournal&) = delete;

  // Called often. Writes unsaved changes in the background, at most twice per second; removes the journal when
  // everything is saved.
  void update(const Editor& editor);

  // Why changes cannot be written to the journal; once, until a write succeeds.
  std::optional<std::string> take_problem() { return std::exchange(problem_, std::nullopt); }

  // The journals in the folder that no running viewer uses, newest first.
  std::vector<LostSession> lost_sessions() const;
  // Makes the journal of a lost session the one of this viewer.
  void adopt(const std::filesystem::path& lost);
  static void discard(const std::filesystem::path& lost);

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_;
  std::filesystem::path lock_file_;
  int lock_ = -1;                  // file descriptor
  uint64_t written_revision_ = 0;  // 0: there is no journal
  bool has_failed_ = false;        // the last write
  std::optional<std::string> problem_;
  std::chrono::steady_clock::time_point last_write_{};
  std::optional<BackgroundTask<Result<void>>> task_{std::in_place};
};

}  // namespace etendue::viewer
