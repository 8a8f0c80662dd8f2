// The scene as a glTF file, written while the interface goes on.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "render/document.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

struct SavedScene {
  std::string file;
  std::vector<std::string> warnings;  // what the file could not take
};

class SceneWriter {
 public:
  explicit SceneWriter(std::function<void()> wake) : job_(std::move(wake)) {}

  // Writes the document as it is now. One at a time: the caller asks busy() before.
  void write(const std::string& file, const render::Document& document);
  bool busy() const { return job_.running(); }
  std::optional<Result<SavedScene>> take() { return job_.take(); }

 private:
  Job<Result<SavedScene>> job_;
};

}  // namespace etendue::viewer
