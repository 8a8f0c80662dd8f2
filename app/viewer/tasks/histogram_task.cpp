#include "viewer/tasks/histogram_task.h"

namespace etendue::viewer {
namespace {

constexpr double kInterval = 0.5;  // seconds between two computations

}  // namespace

bool HistogramTask::is_early() const {
  return std::chrono::duration<double>(Clock::now() - start_).count() < kInterval;
}

void HistogramTask::update(const TaskContext& context, const Input& input) {
  if (auto result = task_.take_result()) {
    result_ = std::move(*result);
    computed_ = running_;
  }
  if (!input.pixels) return;
  requested_ = input;
  is_outdated_ = !is_current();
  if (task_.running() || is_early() || !is_outdated_) return;
  start_ = Clock::now();
  running_ = requested_;
  task_.start([input = running_] { return image_statistics(*input.pixels, input.width, input.exposure, input.curve); },
              context.wake);
}

void HistogramTask::reset(const TaskContext&) {
  task_.abandon();
  result_.reset();
  requested_ = running_ = computed_ = {};
  is_outdated_ = false;
}

}  // namespace etendue::viewer
