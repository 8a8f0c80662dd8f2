// Computes the statistics of the image on screen in the background.
#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "image/display.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/image_statistics.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

class HistogramTask final : public Task {
 public:
  // An image, and how it is displayed.
  struct Input {
    std::shared_ptr<const std::vector<Rgb>> pixels;
    int width = 0;
    float exposure = 0;
    image::ToneCurve curve{};

    friend bool operator==(const Input&, const Input&) = default;
  };

  // Called once per frame while the statistics are shown. Another input starts the computation again, at most twice per
  // second.
  void update(const TaskContext& context, const Input& input);
  // The statistics are not shown.
  void pause() { is_outdated_ = false; }
  void reset(const TaskContext&) override;
  bool has_update() const override { return task_.has_result() || (is_waiting() && !is_early()); }
  // A computation is to start as soon as the interval has passed.
  bool is_waiting() const override { return is_outdated_ && !task_.running(); }

  // Null before the first result.
  const ImageStatistics* result() const { return result_ ? &*result_ : nullptr; }
  // Whether the result belongs to the last input.
  bool is_current() const { return result_ && computed_ == requested_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool is_early() const;

  Input requested_;
  Input running_;
  Input computed_;
  bool is_outdated_ = false;
  Clock::time_point start_{};
  std::optional<ImageStatistics> result_;
  BackgroundTask<ImageStatistics> task_;
};

}  // namespace etendue::viewer
