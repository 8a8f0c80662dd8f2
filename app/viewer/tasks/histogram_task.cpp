#include "viewer/tasks/histogram_task.h"

namespace etendue::viewer {
namespace {

constexpr double kInterval = 0.5;  // seconds between two computations

}  // namespace

void HistogramTask::update(const TaskContext& context, const std::shared_ptr<const render::Frame>& frame,
                           float exposure, image::ToneCurve curve) {
  if (auto result = task_.take_result()) {
    result_ = std::move(*result);
    computed_ = running_;
  }
  if (!frame) return;
  requested_ = {.pixels = frame->pixels, .width = frame->width, .exposure = exposure, .curve = curve};
  const bool is_early = std::chrono::duration<double>(Clock::now() - start_).count() < kInterval;
  if (task_.running() || is_early || is_current()) return;
  start_ = Clock::now();
  running_ = requested_;
  task_.start([input = running_] { return image_statistics(*input.pixels, input.width, input.exposure, input.curve); },
              context.wake);
}

void HistogramTask::reset(const TaskContext&) {
  task_.abandon();
  result_.reset();
  requested_ = running_ = computed_ = {};
}

}  // namespace etendue::viewer
