// Edits that need the content of files: images of textures, and material files.
//
// Another thread reads the files; the edit is then made to the document of that moment. Edits keep their order.
#pragma once
#include <deque>
#include <functional>
#include <optional>

#include "base/result.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

struct AppState;

class FileEdits {
 public:
  using Edit = std::function<void(AppState&)>;
  using Work = std::function<Result<Edit>()>;

  explicit FileEdits(std::function<void()> wake) : wake_(std::move(wake)) {}

  // `work` runs on another thread and returns what is to be done with its results on the thread of the interface.
  void start(Work work);
  // Discards the edits that have not been made. Work that has begun continues without effect on the document.
  void cancel();
  bool is_busy() const { return task_.running() || !queue_.empty(); }
  // The edit that comes next, as soon as its work is done.
  std::optional<Result<Edit>> take_result();

 private:
  void start_next();

  std::function<void()> wake_;
  std::deque<Work> queue_;
  BackgroundTask<Result<Edit>> task_;
};

}  // namespace etendue::viewer
