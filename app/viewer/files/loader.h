// Opens files in the background.
//
// The content of a file decides what it is: a scene, a session (.etendue), a snapshot (an .exr with a stored document),
// or an environment map (any other .exr, or another image). The picture of a snapshot is known before its scene, and a
// rendering continues from the checkpoint beside the snapshot. A scene has a picture as soon as its geometry is known, if
// it has textures, which take longer.
#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/document.h"
#include "render/resume_point.h"
#include "viewer/files/stored_picture.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

struct OpenedFile {
  enum class Kind { scene, session, recovered, snapshot, environment };
  Kind kind = Kind::scene;
  std::string file;
  render::Document document;
  std::optional<render::ResumePoint> resume_point = {};  // of a snapshot with samples
};

class Loader {
 public:
  explicit Loader(std::function<void()> wake) : wake_(std::move(wake)) {}

  // Starts to read a file; a file that is still being read is abandoned. If it is an environment map, it is added to a
  // copy of `current`. Scenes without lights get the built-in environment of this name (empty: the default).
  void open(const std::string& file, const render::Document& current, const std::string& environment);
  // Starts to read the journal of a session that ended unexpectedly.
  void recover(const std::string& journal);
  void cancel() { task_.abandon(); }
  // The picture of the file that is being opened, as soon as it is known; null before, and for files without one.
  std::shared_ptr<const StoredPicture> picture() const;
  bool is_busy() const { return task_.running(); }
  // The file that was opened last.
  const std::string& file() const { return file_; }
  // Seconds since it was opened.
  double seconds() const;
  std::optional<Result<OpenedFile>> take_result() { return task_.take_result(); }

 private:
  struct Shared;  // with the thread that reads

  std::function<void()> wake_;
  std::shared_ptr<Shared> shared_;
  BackgroundTask<Result<OpenedFile>> task_;
  std::string file_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace etendue::viewer
