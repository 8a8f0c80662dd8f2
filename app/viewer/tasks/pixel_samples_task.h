// Draws the samples of one pixel again, beside the main rendering and in the same order, and collects their statistics.
#pragma once
#include <memory>
#include <optional>

#include "render/document.h"
#include "scene/forward.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/pixel_statistics.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

class PixelSamplesTask final : public Task {
 public:
  PixelSamplesTask();
  ~PixelSamplesTask() override;

  void set_pixel(Vec2i pixel) { pixel_ = pixel; }
  const std::optional<Vec2i>& pixel() const { return pixel_; }

  // Called once per frame while the statistics are shown. An edit of anything that changes the samples starts again.
  void update(const TaskContext& context, uint32_t target_samples);
  // Stops the work; the statistics remain.
  void pause();
  // The pixel stays selected in the new document.
  void reset(const TaskContext&) override {}
  bool has_update() const override { return task_.has_result(); }
  // Whether samples are missing.
  bool is_incomplete() const { return pixel_ && !complete_; }

  // The statistics of the selected pixel; null if there are none yet.
  std::shared_ptr<const PixelStatistics> result() const { return pixel_ ? result_ : nullptr; }

 private:
  // Everything that the samples depend on.
  struct Input {
    std::shared_ptr<const scene::CompiledScene> scene;
    Vec2i pixel{0};
    uint32_t target_samples = 0;
    Camera camera;
    int width = 0;
    int height = 0;
    film::FilterKind filter{};
    render::MethodSettings method;
    std::vector<std::string> forced_flags;
    uint64_t seed = 0;

    friend bool operator==(const Input&, const Input&) = default;
  };
  class Accumulator;

  std::optional<Vec2i> pixel_;
  std::optional<Input> input_;
  bool complete_ = false;  // result_ belongs to input_ and has all samples
  std::shared_ptr<Accumulator> accumulator_;
  std::shared_ptr<const PixelStatistics> result_;
  BackgroundTask<std::shared_ptr<const PixelStatistics>> task_;
};

}  // namespace etendue::viewer
