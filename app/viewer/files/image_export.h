// Saves the rendered image in the background, with everything that is needed to render it again.
//
// The image is reproducible only if all pixels have the same number of samples. The export therefore lets the session
// finish the current pass, copies the film, and lets the session continue.
//
// A snapshot can be continued: the checkpoint with its exact samples is a second file (render::checkpoint_of_image).
#pragma once
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "base/result.h"
#include "render/document.h"
#include "viewer/tasks/background_task.h"

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

class Editor;

// Writes the image of a session that renders `document`, with a certificate if the format stores one. The session must not
// change meanwhile.
Result<void> write_image_of(render::Session& session, const render::Document& document, const std::string& file);

struct SavedImage {
  std::string file;
  bool has_state = false;     // the file contains the document (.exr)
  render::Document document;  // as it was when the image was saved
  uint64_t revision = 0;      // of the document (Editor::revision)
};

enum class SavedSamples : uint8_t { none, checkpoint };

class ImageExport {
 public:
  ImageExport(render::Session& session, Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), wake_(std::move(wake)) {}

  // Queues a file. .exr stores radiance, the document and a certificate; .hdr stores radiance; .png the displayed
  // image. A checkpoint can be written beside it.
  void request(const std::string& file, SavedSamples samples = SavedSamples::none) {
    requests_.push_back({file, samples});
  }
  bool is_busy() const { return !requests_.empty(); }

  // Called once per frame. Returns a file that was written, or an error.
  std::optional<Result<SavedImage>> update();

 private:
  struct Request {
    std::string file;
    SavedSamples samples;
  };
  enum class Stage { idle, finishing_pass, writing };
  void finish_pass();

  render::Session& session_;
  Editor& editor_;
  std::function<void()> wake_;
  BackgroundTask<Result<std::string>> task_;  // an empty name: the document was edited before the film was copied
  std::deque<Request> requests_;
  Stage stage_ = Stage::idle;
  uint64_t version_ = 0;  // of the document that is exported
  SavedImage saved_;      // what is being written
  bool was_paused_ = false;
};

}  // namespace etendue::viewer
