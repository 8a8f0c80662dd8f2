// Opening files without waiting for them.
//
// A file is what it contains: a scene, a snapshot (an .exr that carries a state), or light from all around (.hdr,
// .exr).
#pragma once
#include <chrono>
#include <optional>
#include <string>

#include "render/document.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

struct Opened {
  enum class Kind { scene, snapshot, environment };
  Kind kind = Kind::scene;
  std::string file;
  render::Document document;
};

class Loader {
 public:
  explicit Loader(std::function<void()> wake) : job_(std::move(wake)) {}

  // `current` receives the light if the file turns out to be an environment.
  void open(const std::string& file, const render::Document& current);
  void cancel() { job_.abandon(); }
  bool busy() const { return job_.running(); }
  const std::string& file() const { return file_; }
  double seconds() const;
  std::optional<Result<Opened>> take() { return job_.take(); }

 private:
  Job<Result<Opened>> job_;
  std::string file_;
  std::chrono::steady_clock::time_point started_;
};

}  // namespace etendue::viewer
