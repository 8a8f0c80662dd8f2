// Measures the selected material: checks, BSDF slice, lobe, albedo, and a rendered preview sphere. A second material
// can be pinned for comparison.
//
// The Material panel and the Surface panel share this task. Each frame, a panel requests what it shows. The
// measurements take some hundredths of a second and are repeated after each edit. The preview spheres have small
// sessions with one thread each, which stop after a few hundred samples per pixel.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bsdf_analysis/checks.h"
#include "bsdf_analysis/drawings.h"
#include "scene/preview.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/task.h"

namespace etendue::render {
struct Frame;
}

namespace etendue::viewer {

// The measurements of one material.
struct SurfaceMeasurement {
  Material material;
  std::string model;  // label of its reflection model
  bsdf_analysis::SurfaceAnalysis audit;
  bsdf_analysis::Slice slice;
  std::vector<bsdf_analysis::LobeSurface> lobes;  // reflection; then transmission, if there is any
};

class SurfaceAnalysis final : public Task {
 public:
  struct Parameters {
    Number<float> angle{
        "surface.angle", "View angle", 45, {0, 89}, "Angle between the view direction and the surface normal",
        "\u00b0"};
    Toggle cosine{"surface.cosine", "Show f cos \u03b8", true,
                  "On: f cos \u03b8, the radiance reflected from uniform light. Off: the BSDF f"};
    Choice<bsdf_analysis::LengthScale> length{
        "surface.length", "Lobe scale", bsdf_analysis::LengthScale::linear,
        "Radius of lobes: proportional to f, or to its fourth root, which shows details next to a peak"};
    Choice<scene::PreviewLight> light{
        "surface.light", "Preview light", scene::PreviewLight::studio,
        "Illumination of the preview sphere. White furnace test: a material that conserves energy disappears"};
    auto all() { return std::tie(angle, cosine, length, light); }
  };
  Parameters parameters;

  // A linear RGB image, three numbers per pixel.
  struct Preview {
    int width = 0;
    int height = 0;
    uint32_t samples = 0;
    std::shared_ptr<const std::vector<float>> pixels;  // null until the first sample
  };
  static constexpr int kPreviewSize = 192;  // pixels
  static constexpr size_t kSides = 2;       // side 0 is the selected material, side 1 the pinned one

  SurfaceAnalysis();
  ~SurfaceAnalysis() override;

  // To be called in each frame in which the checks, or the previews as well, are shown.
  void request_checks() { checks_requested_ = true; }
  void request_previews() { previews_requested_ = true; }
  // Called once per frame, after the requests. `material` is the index of the selected material, negative if there is
  // none.
  void update(const TaskContext& context, int material);
  void reset(const TaskContext& context) override;
  bool has_update() const override;

  // The measurement of one side; null if there is no such material or it was not measured yet.
  const SurfaceMeasurement* result(size_t side) const { return results_[side].get(); }
  // Whether a panel has requested the checks in this frame.
  bool checks_are_shown() const { return checks_shown_; }
  // Whether the measurements belong to the materials and parameters as they are.
  bool is_current() const;
  const Preview& preview(size_t side) const { return renderings_[side].preview; }

  // Pins the selected material for comparison until `unpin`.
  void pin();
  void unpin();
  bool can_pin() const { return selected_.has_value(); }
  bool has_pinned() const { return pinned_.has_value(); }

 private:
  using Results = std::array<std::shared_ptr<const SurfaceMeasurement>, kSides>;
  // What the measurements depend on.
  struct Input {
    std::optional<Material> materials[kSides];
    float angle = 0;
    bool cosine = true;

    friend bool operator==(const Input&, const Input&) = default;
  };
  struct PreviewRendering {
    std::unique_ptr<render::Session> session;
    std::optional<Material> material;
    scene::PreviewLight light = scene::PreviewLight::studio;
    Environment environment;
    std::shared_ptr<const render::Frame> frame;
    Preview preview;
  };

  Input input() const;
  static Results measure(const Input& input, const Input& previous_input, const Results& previous);
  void update_previews(const TaskContext& context, bool requested);
  static void take_frame(PreviewRendering& rendering);

  bool checks_requested_ = false;
  bool previews_requested_ = false;
  bool checks_shown_ = false;
  std::optional<Material> selected_;
  std::optional<Material> pinned_;
  Input measured_input_;   // of results_
  Input measuring_input_;  // of task_
  Results results_;
  BackgroundTask<Results> task_;
  std::array<PreviewRendering, kSides> renderings_;
};

}  // namespace etendue::viewer
