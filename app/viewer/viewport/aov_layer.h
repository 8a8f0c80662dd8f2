// Arbitrary output variables (AOVs) in the viewport: albedo, normals, depth, ids, and the error of each pixel. They are
// computed beside the main rendering, which continues.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "spectrum/rgb.h"
#include "viewer/tasks/background_task.h"

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

class Editor;

struct AovImage {
  std::string name;
  uint64_t version = 0;    // of the document
  uint32_t samples = 0;    // of the rendering, for the error
  std::string scale = {};  // meaning of the colours: "0.001 to 0.03"
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;  // linear colours
};

// The name of the error layer. The other names are those of render::aov_names().
inline constexpr const char* kErrorLayer = "error";
std::vector<std::string> aov_layer_names();

class AovLayer {
 public:
  AovLayer(render::Session& session, const Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), wake_(std::move(wake)) {}

  // Called once per frame with the name of the layer to show, or an empty name. Returns true if there is a new image.
  bool update(const std::string& name);
  const AovImage& image() const { return image_; }
  bool is_busy() const { return task_.running(); }

 private:
  bool is_outdated(const std::string& name) const;

  render::Session& session_;
  const Editor& editor_;
  std::function<void()> wake_;
  BackgroundTask<AovImage> task_;
  AovImage image_;
};

}  // namespace etendue::viewer
