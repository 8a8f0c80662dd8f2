// Layers in the viewport: what lies under the pixels (albedo, normals, depth, ids), and how much each of them errs.
// Made beside the rendering, which goes on.
#pragma once
#include <string>
#include <vector>

#include "render/session.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

struct AovPicture {
  std::string name;
  uint64_t version = 0;
  uint32_t samples = 0;  // that the errors are of
  std::string scale;     // of what is measured in colours, in words
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  // linear, made to be looked at
};

// The layer of errors, beside those of render::aov_names().
inline constexpr const char* kErrorLayer = "error";
std::vector<std::string> layer_names();

class AovView {
 public:
  AovView(render::Session& session, const Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), job_(std::move(wake)) {}

  // Called once a frame with the name of the layer to show, or nothing; true if there is a new picture.
  bool advance(const std::string& name);
  const AovPicture& picture() const { return picture_; }
  bool busy() const { return job_.running(); }

 private:
  bool is_stale(const std::string& name) const;

  render::Session& session_;
  const Editor& editor_;
  Job<AovPicture> job_;
  AovPicture picture_;
};

}  // namespace etendue::viewer
