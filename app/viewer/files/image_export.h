// Saves the rendered image in the background, with everything that is needed to render it again.
//
// The image is reproducible only if all pixels have the same number of samples. The export therefore lets the session
// finish the current pass, copies the film, and lets the session continue.
#pragma once
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "base/result.h"
#include "viewer/tasks/background_task.h"

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

class Editor;

class ImageExport {
 public:
  ImageExport(render::Session& session, Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), wake_(std::move(wake)) {}

  // Queues a file. .exr stores radiance, the document and a certificate; .hdr stores radiance; .png the displayed
  // image.
  void request(const std::string& file) { files_.push_back(file); }
  bool is_busy() const { return !files_.empty(); }

  // Called once per frame. Returns the name of a file that was written, or an error.
  std::optional<Result<std::string>> update();

 private:
  enum class Stage { idle, finishing_pass, writing };
  void finish_pass();

  render::Session& session_;
  Editor& editor_;
  std::function<void()> wake_;
  BackgroundTask<Result<std::string>> task_;  // an empty name: the document was edited before the film was copied
  std::deque<std::string> files_;
  Stage stage_ = Stage::idle;
  uint64_t version_ = 0;  // of the document that is exported
  bool was_paused_ = false;
};

}  // namespace etendue::viewer
