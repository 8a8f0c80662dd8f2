// Saves the state of the document as a session file in the background.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "base/result.h"
#include "render/document.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

struct SavedSession {
  std::string file;
  render::Document document;
  uint64_t revision = 0;  // of the document (Editor::revision)
};

class SessionExport {
 public:
  explicit SessionExport(std::function<void()> wake) : wake_(std::move(wake)) {}

  void write(const std::string& file, const render::Document& document, uint64_t revision);
  bool is_busy() const { return task_.running(); }
  std::optional<Result<SavedSession>> take_result() { return task_.take_result(); }

 private:
  std::function<void()> wake_;
  BackgroundTask<Result<SavedSession>> task_;
};

}  // namespace etendue::viewer
