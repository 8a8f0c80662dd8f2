// Saves the scene as a glTF file in the background.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "viewer/tasks/background_task.h"

namespace etendue::render {
struct Document;
}
namespace etendue::scene {
struct Scene;
}

namespace etendue::viewer {

struct SavedScene {
  std::string file;
  std::shared_ptr<const scene::Scene> scene;  // as it was when it was saved
  std::vector<std::string> warnings;          // what glTF cannot represent
};

class SceneExport {
 public:
  explicit SceneExport(std::function<void()> wake) : wake_(std::move(wake)) {}

  // Writes the document as it is now. Only one file can be written at a time.
  void write(const std::string& file, const render::Document& document);
  bool is_busy() const { return task_.running(); }
  std::optional<Result<SavedScene>> take_result() { return task_.take_result(); }

 private:
  std::function<void()> wake_;
  BackgroundTask<Result<SavedScene>> task_;
};

}  // namespace etendue::viewer
