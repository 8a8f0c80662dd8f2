// Arbitrary output variables (AOVs) in the viewport: albedo, normals, depth, ids, the error of each pixel, the light of
// single bounces and path classes, the terms of the equation of transfer in scenes with participating media, and the
// importance of places. They are computed beside the main rendering, which continues. Parts of the radiance are computed
// again with more samples until they have 256 per pixel. The denoised image (film/denoise/denoise.h) is for display only.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "render/denoised_image.h"
#include "spectrum/rgb.h"
#include "viewer/tasks/background_task.h"

namespace etendue::render {
class Session;
}
namespace etendue::scene {
class CompiledScene;
}

namespace etendue::viewer {

class Editor;

struct AovImage {
  std::string name;
  uint64_t version = 0;      // of the document
  uint32_t samples = 0;      // of the rendering, for layers of the film; of the image, for parts of the radiance
  bool is_radiance = false;  // in cd/m^2, shown like the image; else colours that are shown as they are
  std::string scale = {};    // meaning of the colours: "0.001 to 0.03"
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;                                            // linear colours
  std::shared_ptr<const render::DenoiseFeatures> features = nullptr;  // of the denoised image, for its next update
  render::Denoiser denoiser = render::Denoiser::automatic;            // that was asked for
};

// The name of the error layer. The other names are those of render::aov_names(), render::light_path_layer_names() and
// render::medium_aov_names().
inline constexpr const char* kErrorLayer = "error";
// The name of the denoised image, which is computed from the film, as the error layer is.
inline constexpr const char* kDenoisedLayer = "denoised";
// The name of the layer with the importance of places for a camera (render::audit_importance): that of the view when the
// layer was chosen, so that the view can be moved to look at it from elsewhere.
inline constexpr const char* kImportanceLayer = "importance";
// The layers of a scene; null: all layers.
std::vector<std::string> aov_layer_names(const scene::CompiledScene* scene = nullptr);

class AovLayer {
 public:
  AovLayer(render::Session& session, const Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), wake_(std::move(wake)) {}
  ~AovLayer();
  AovLayer(const AovLayer&) = delete;
  AovLayer& operator=(const AovLayer&) = delete;

  // Called once per frame with the name of the layer to show, or an empty name. Returns true if there is a new image.
  // Regression takes the place of a denoiser that fails.
  bool update(const std::string& name, render::Denoiser denoiser = render::Denoiser::automatic);
  const AovImage& image() const { return image_; }
  bool is_busy() const { return task_.running(); }

 private:
  struct Request {
    std::string name;
    uint64_t version = 0;
  };

  bool is_outdated(const std::string& name) const;
  void choose_importance_camera(const std::string& name);
  void start_importance(std::shared_ptr<const scene::CompiledScene> scene, uint64_t version);
  void start_denoising(std::shared_ptr<const scene::CompiledScene> scene, uint64_t version);
  void start(const std::string& name, std::shared_ptr<const scene::CompiledScene> scene, uint64_t version);
  void cancel();

  render::Session& session_;
  const Editor& editor_;
  std::function<void()> wake_;
  std::shared_ptr<std::atomic<bool>> cancelled_;  // of work that takes long
  BackgroundTask<AovImage> task_;
  Request requested_;  // what the task computes
  std::string shown_;  // the name in the previous frame
  std::string importance_scene_;
  Camera importance_camera_;  // of the scene with this name
  render::Denoiser denoiser_ = render::Denoiser::automatic;
  AovImage image_;
};

}  // namespace etendue::viewer
