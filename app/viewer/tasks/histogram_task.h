// Computes the statistics of the newest frame in the background.
#pragma once
#include <chrono>
#include <memory>
#include <optional>

#include "render/display_frame.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/image_statistics.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

class HistogramTask final : public Task {
 public:
  // Called once per frame while the statistics are shown. A new frame or changed display settings start the computation
  // again, at most twice per second.
  void update(const TaskContext& context, const std::shared_ptr<const render::Frame>& frame, float exposure,
              image::ToneCurve curve);
  void reset(const TaskContext&) override;
  bool has_update() const override { return task_.has_result(); }

  // Null before the first result.
  const ImageStatistics* result() const { return result_ ? &*result_ : nullptr; }
  // Whether the result belongs to the newest frame and display settings.
  bool is_current() const { return result_ && computed_ == requested_; }

 private:
  struct Input {
    std::shared_ptr<const std::vector<Rgb>> pixels;
    int width = 0;
    float exposure = 0;
    image::ToneCurve curve{};

    friend bool operator==(const Input&, const Input&) = default;
  };
  using Clock = std::chrono::steady_clock;

  Input requested_;
  Input running_;
  Input computed_;
  Clock::time_point start_{};
  std::optional<ImageStatistics> result_;
  BackgroundTask<ImageStatistics> task_;
};

}  // namespace etendue::viewer
