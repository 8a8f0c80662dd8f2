#include "viewer/tasks/pixel_samples_task.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "render/pixel_samples.h"
#include "render/renderer.h"
#include "render/session.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {
namespace {

// Independent renderings of the pixel besides the one that is shown. Their spread gives the error, also for samplers
// whose points are correlated.
constexpr size_t kReplicas = 8;
constexpr double kStudentQuantile = 2.3646;  // 97.5 % quantile of Student's t distribution with kReplicas - 1 degrees

constexpr uint32_t kWindow = film::kHalfBuffers * render::kTableSamples;  // samples that are drawn together
constexpr double kSliceSeconds = 0.15;                                    // between two results

// The next sample count for the running mean: an even number, about 9 % larger, or the next power of two.
uint32_t next_recorded_count(uint32_t samples) {
  const uint32_t step = std::max(2u, static_cast<uint32_t>(samples * 0.09) & ~1u);
  uint32_t power = 2;
  while (power <= samples) power *= 2;
  return std::min(samples + step, power);
}

}  // namespace

// The samples drawn so far and their statistics. One background task at a time uses it.
class PixelSamplesTask::Accumulator {
 public:
  Accumulator(const render::Document& document, const Input& input) : samples_(document, input.scene, input.pixel) {
    statistics_.pixel = input.pixel;
    statistics_.target_samples = input.target_samples;
  }

  void cancel() { cancelled_ = true; }
  bool has_all_samples() const { return drawn_ >= statistics_.target_samples; }

  // Draws samples for one slice of time. Null if the task was cancelled.
  std::shared_ptr<const PixelStatistics> draw_slice() {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    if (!count_dimensions()) return nullptr;
    while (!has_all_samples() && std::chrono::duration<double>(Clock::now() - start).count() < kSliceSeconds) {
      const uint32_t window_end = (drawn_ / kWindow + 1) * kWindow;
      if (!draw_until(std::min(statistics_.target_samples, window_end))) return nullptr;
    }
    const double mean = (half_sums_[0] + half_sums_[1]) / drawn_;
    statistics_.histogram = histogram_of(luminances_);
    statistics_.tail = tail_.report();
    statistics_.mean = Rgb(static_cast<float>(color_sums_[0] / drawn_), static_cast<float>(color_sums_[1] / drawn_),
                           static_cast<float>(color_sums_[2] / drawn_));
    statistics_.standard_deviation = std::sqrt(std::max(0.0, sum_of_squares_ / drawn_ - mean * mean));
    auto result = std::make_shared<PixelStatistics>(statistics_);
    if (result->samples() != drawn_) result->running_mean.push_back(estimate());
    return result;
  }

 private:
  bool count_dimensions() {
    if (statistics_.counted_samples > 0) return true;
    const uint32_t samples = std::min(statistics_.target_samples, kWindow);
    const auto counts = samples_.drawn_dimensions(samples, [this] { return !cancelled_; });
    if (!counts) return false;
    statistics_.drawn_dimensions = *counts;
    statistics_.counted_samples = samples;
    return true;
  }

  bool draw_until(uint32_t end) {
    for (uint32_t r = 0; r < replicas_.size(); ++r) {
      replicas_[r].resize(end - drawn_);
      if (!samples_.draw(drawn_, r, replicas_[r], [this] { return !cancelled_; })) return false;
    }
    for (const size_t first = drawn_; drawn_ < end;) add_sample(drawn_ - first);
    return true;
  }

  void add_sample(size_t i) {
    const Rgb& sample = replicas_[0][i];
    const double y = std::max(0.0f, luminance(sample));
    add_to_tail(y);
    for (int c = 0; c < 3; ++c) color_sums_[static_cast<size_t>(c)] += double{sample[c]};
    half_sums_[drawn_ % 2] += y;
    sum_of_squares_ += y * y;
    for (size_t r = 0; r < kReplicas; ++r) replica_sums_[r] += double{luminance(replicas_[r + 1][i])};
    luminances_.push_back(static_cast<float>(y));
    statistics_.maximum = std::max(statistics_.maximum, y);
    ++drawn_;
    if (drawn_ != next_recorded_ && !has_all_samples()) return;
    statistics_.running_mean.push_back(estimate());
    next_recorded_ = next_recorded_count(drawn_);
  }

  // As in the main rendering: the tail statistics use the deviation from the mean of the previous samples. The first
  // two samples are skipped.
  void add_to_tail(double y) {
    if (drawn_ < 2) return;
    const auto deviation = static_cast<float>(y - (half_sums_[0] + half_sums_[1]) / drawn_);
    tail_.add(std::span(&deviation, 1), y);
  }

  PixelStatistics::Estimate estimate() const {
    double sum = 0;
    double sum_of_squares = 0;
    for (const double replica_sum : replica_sums_) {
      sum += replica_sum / drawn_;
      sum_of_squares += sqr(replica_sum / drawn_);
    }
    const double variance = std::max(0.0, sum_of_squares - sum * sum / kReplicas) / (kReplicas - 1);
    const double first_half = (drawn_ + 1) / 2;
    const double second_half = drawn_ / 2;
    return {.samples = drawn_,
            .mean = (half_sums_[0] + half_sums_[1]) / drawn_,
            .confidence = kStudentQuantile * std::sqrt(variance),
            .half_means = {half_sums_[0] / first_half, second_half > 0 ? half_sums_[1] / second_half : 0}};
  }

  render::PixelSamples samples_;
  std::atomic<bool> cancelled_{false};
  std::array<std::vector<Rgb>, kReplicas + 1> replicas_;  // samples of the current window; the first one is shown
  uint32_t drawn_ = 0;
  uint32_t next_recorded_ = 2;
  std::array<double, 3> color_sums_{};
  std::array<double, 2> half_sums_{};
  std::array<double, kReplicas> replica_sums_{};
  double sum_of_squares_ = 0;
  std::vector<float> luminances_;
  film::TailAccumulator tail_;
  PixelStatistics statistics_;
};

PixelSamplesTask::PixelSamplesTask() = default;
PixelSamplesTask::~PixelSamplesTask() { pause(); }

void PixelSamplesTask::pause() {
  if (accumulator_) accumulator_->cancel();
  task_.abandon();
  accumulator_.reset();
  input_.reset();
  complete_ = false;
}

void PixelSamplesTask::update(const TaskContext& context, uint32_t target_samples) {
  complete_ = false;
  if (auto result = task_.take_result(); result && *result) result_ = std::move(*result);
  const auto& d = context.editor.document();
  if (pixel_ && (pixel_->x >= d.width || pixel_->y >= d.height)) {
    pixel_.reset();
    pause();
  }
  if (!render::PixelSamples::supports(d)) {
    pause();
    result_.reset();
    return;
  }
  const auto scene = context.session.scene();
  if (!pixel_ || !scene || context.session.status().version != context.editor.version()) return;
  const Input input{.scene = scene,
                    .pixel = *pixel_,
                    .target_samples = target_samples,
                    .camera = d.camera,
                    .width = d.width,
                    .height = d.height,
                    .filter = d.filter,
                    .method = d.method,
                    .forced_flags = d.forced_flags,
                    .seed = d.seed};
  if (!input_ || !(*input_ == input)) {
    pause();
    if (result_ && result_->pixel != *pixel_) result_.reset();
    input_ = input;
    accumulator_ = std::make_shared<Accumulator>(d, input);
  }
  if (task_.running()) return;
  complete_ = accumulator_->has_all_samples();
  if (!complete_) task_.start([accumulator = accumulator_] { return accumulator->draw_slice(); }, context.wake);
}

}  // namespace etendue::viewer
