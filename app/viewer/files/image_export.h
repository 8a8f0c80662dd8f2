// Snapshots: the picture in a file, with everything that is needed to make it again.
//
// A film is only worth keeping between two passes, when every pixel has the same number of samples: then the same
// settings and that number give the same picture bit for bit. A capture lets the session finish the pass it is in,
// takes the film, and lets it go on.
#pragma once
#include <deque>
#include <optional>
#include <string>

#include "viewer/state/editor.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

class Capture {
 public:
  Capture(render::Session& session, Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), job_(std::move(wake)) {}

  // As render::write_image does: .exr takes all, with a certificate; .hdr the radiance; .png what the screen shows of
  // it.
  void request(const std::string& file);
  bool busy() const { return !files_.empty(); }
  const std::string& file() const { return files_.front(); }

  // Called once a frame. The name of a file that was finished, or what went wrong.
  std::optional<Result<std::string>> advance();

 private:
  enum class Stage { idle, settling, writing };
  void begin();

  render::Session& session_;
  Editor& editor_;
  Job<Result<std::string>> job_;  // an empty name: the picture had changed
  std::deque<std::string> files_;
  Stage stage_ = Stage::idle;
  uint64_t version_ = 0;
  bool was_paused_ = false;
};

}  // namespace etendue::viewer
