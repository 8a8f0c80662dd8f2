#include "bench/live_benchmark.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "bench/measurement_schedule.h"
#include "bench/timed_render.h"
#include "film/film_image.h"

namespace etendue::bench {
namespace {

using metrics::Abscissa;
using Phase = LiveBenchmarkSnapshot::Phase;

constexpr double kTurn = 0.33;  // seconds
// The reference is looked at anew when its samples have grown by this part.
constexpr uint32_t kReferenceGrowth = 16;

std::shared_ptr<const render::Frame> frame_of(std::span<const float> rgb, int width, int height, uint32_t samples) {
  std::vector<Rgb> pixels(rgb.size() / 3);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
  auto frame = std::make_shared<render::Frame>();
  frame->width = width, frame->height = height;
  frame->pixels = std::make_shared<const std::vector<Rgb>>(std::move(pixels));
  frame->samples = samples;
  return frame;
}

// One repeat of one method, and what was measured of it.
struct Run {
  Run(size_t m, int repeat, const render::Document& d, const std::shared_ptr<const scene::CompiledScene>& scene)
      : method(m), lane(d, scene), measured{repeat, {}}, corrected{repeat, {}} {}

  void add(const metrics::ErrorPoint& point, const metrics::ReferenceNoise& noise) {
    // What lies between two steps is only the head of the curve: the next turn moves it.
    if (!measured.points.empty() && !head_stays) measured.points.pop_back(), corrected.points.pop_back();
    measured.points.push_back(point);
    corrected.points.push_back(metrics::without_noise(point, noise));
    head_stays = lane.samples() >= step;
    while (step <= lane.samples()) step = next_count(step);
  }

  size_t method;
  TimedRender lane;
  metrics::ErrorCurve measured, corrected;
  uint32_t step = 1;  // the number of samples at which the next point is to be measured
  bool head_stays = false;
};

}  // namespace

class LiveBenchmark::Impl {
 public:
  Impl(LiveBenchmarkPlan plan, std::function<void()> wake)
      : plan_(std::move(plan)), wake_(std::move(wake)), frames_(plan_.methods.size()), workers_(plan_.threads) {
    const auto& d = plan_.methods.front().document;
    const size_t film = static_cast<size_t>(d.width) * static_cast<size_t>(d.height) * sizeof(film::Film::Pixel);
    const auto fitting = static_cast<int>(std::min<size_t>(kMostFilmBytes / (film * plan_.methods.size()), 10000));
    plan_.repeats = std::clamp(plan_.repeats, 1, std::max(fitting, 1));
    publish();
    thread_ = std::thread([this] { loop(); });
  }

  ~Impl() {
    command([this] { quit_ = true; });
    thread_.join();
  }

  void stop() {
    command([this] { wanted_ = false; });
  }

  void go_on() {
    command([this] {
      if (done_) plan_.seconds *= 2, plan_.samples *= 2;
      done_ = false, wanted_ = true;
    });
  }

  std::shared_ptr<const LiveBenchmarkSnapshot> snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_;
  }

 private:
  template <class F>
  void command(F&& change) {
    {
      const std::lock_guard lock(mutex_);
      change();
      going_ = wanted_ && !quit_;
    }
    changed_.notify_all();
  }

  void loop() {
    prepare();
    std::unique_lock lock(mutex_);
    while (!quit_) {
      const double seconds = plan_.seconds;
      const uint32_t samples = plan_.samples;
      lock.unlock();
      const bool goes = going_, turned = goes && turn(seconds, samples);
      if (!turned) keep_reference();
      lock.lock();
      done_ = goes && !turned;
      phase_ = done_ ? Phase::done : goes ? Phase::comparing : Phase::stopped;
      lock.unlock();
      publish();
      if (wake_) wake_();
      lock.lock();
      changed_.wait(lock, [&] { return quit_ || phase_ == Phase::comparing || (wanted_ && !done_); });
    }
    keep_reference();
  }

  bool keep_going() const { return going_.load(std::memory_order_relaxed); }

  void prepare() {
    const auto& d = plan_.methods.front().document;
    scene_ = scene::compile(d.scene, d.camera, plan_.compiled);
    if (plan_.reference) return know(std::move(*plan_.reference));
    store_.emplace(d, plan_.cache);
    auto kept = store_->take_up();
    reference_lane_ = std::make_unique<TimedRender>(store_->document(), scene_, std::move(kept.film), kept.seconds);
    kept_samples_ = reference_lane_->samples();
    if (kept_samples_ >= film::kHalfBuffers) look_at_reference();
  }

  // Gives somebody a turn; false if all are done.
  bool turn(double seconds, uint32_t samples) {
    if (reference_is_next()) return reference_turn(), true;
    Run* run = next(seconds, samples);
    if (!run && static_cast<int>(runs_.size() / plan_.methods.size()) < plan_.repeats) {
      begin_repeat();
      run = next(seconds, samples);
    }
    if (!run) return false;
    const bool timed = plan_.rule == Rule::equal_time;
    const double allowed = timed ? std::min(kTurn, seconds - run->lane.seconds()) : kTurn;
    const uint32_t before = run->lane.samples();
    run->lane.run(workers_, timed ? run->step : std::min(run->step, samples), allowed, [&] { return keep_going(); });
    if (run->lane.samples() > before) measure(*run);
    return true;
  }

  bool reference_is_next() const {
    if (!reference_lane_) return false;
    if (reference_lane_->samples() < film::kHalfBuffers) return true;
    double methods = 0;
    for (const auto& run : runs_) methods += run->lane.seconds();
    return reference_lane_->seconds() < methods;
  }

  void reference_turn() {
    TimedRender& lane = *reference_lane_;
    const bool none = lane.samples() < film::kHalfBuffers;
    lane.run(workers_, none ? film::kHalfBuffers : UINT32_MAX, none ? 1e9 : kTurn, [&] { return keep_going(); });
    if (lane.samples() >= std::max(film::kHalfBuffers, reference_.samples + reference_.samples / kReferenceGrowth + 1))
      look_at_reference();
  }

  void look_at_reference() { know(store_->reference_of(reference_lane_->film(), reference_lane_->seconds())); }

  void know(Reference reference) {
    reference_ = std::move(reference);
    const auto& p = reference_.picture;
    reference_frame_ = frame_of(reference_.rgb(), p.width, p.height, reference_.samples);
  }

  // The one that has used the least of the budget among those that have some left.
  Run* next(double seconds, uint32_t samples) {
    const bool timed = plan_.rule == Rule::equal_time;
    const auto used = [&](const Run& run) { return timed ? run.lane.seconds() : run.lane.samples(); };
    Run* least = nullptr;
    for (const auto& run : runs_) {
      const bool done = timed ? run->lane.reached(seconds) : run->lane.samples() >= samples;
      if (!done && (!least || used(*run) < used(*least))) least = run.get();
    }
    return least;
  }

  void begin_repeat() {
    const auto repeat = static_cast<int>(runs_.size() / plan_.methods.size());
    for (size_t m = 0; m < plan_.methods.size(); ++m) {
      render::Document d = plan_.methods[m].document;
      d.seed = seed_of(plan_.seed, m, repeat);
      runs_.push_back(std::make_unique<Run>(m, repeat, d, scene_));
    }
  }

  void measure(Run& run) {
    const auto picture = film::radiance_of(run.lane.film());
    run.add(point_of(picture, reference_, run.lane.seconds(), run.lane.samples()),
            reference_.noise.value_or(metrics::ReferenceNoise{}));
    const auto& film = run.lane.film();
    if (run.measured.repeat == 0)
      frames_[run.method] = frame_of(picture, film.width(), film.height(), run.lane.samples());
  }

  // Work on it is not lost, whatever comes next.
  void keep_reference() {
    if (!reference_lane_ || reference_lane_->samples() <= kept_samples_) return;
    kept_samples_ = reference_lane_->samples();
    store_->keep(reference_lane_->film(), reference_lane_->seconds());
  }

  void publish() {
    auto s = std::make_shared<LiveBenchmarkSnapshot>();
    {
      const std::lock_guard lock(mutex_);
      s->phase = phase_;
      s->seconds = plan_.seconds, s->samples = plan_.samples;
    }
    s->rule = plan_.rule;
    s->repeats = plan_.repeats, s->repeat = static_cast<int>(runs_.size() / plan_.methods.size());
    s->reference = reference_frame_;
    s->reference_error = reference_.standard_error();
    s->reference_samples = reference_lane_ ? reference_lane_->samples() : reference_.samples;
    s->reference_seconds = reference_lane_ ? reference_lane_->seconds() : reference_.seconds;
    for (size_t m = 0; m < plan_.methods.size(); ++m) {
      s->methods.push_back(standing_of(m));
      s->too_noisy =
          s->too_noisy || (reference_.noise && metrics::too_noisy(s->methods.back().corrected, *reference_.noise));
    }
    s->progress = progress(*s);
    const std::lock_guard lock(mutex_);
    snapshot_ = std::move(s);
  }

  Standing standing_of(size_t method) const {
    Standing s;
    s.name = s.measured.name = s.corrected.name = plan_.methods[method].name;
    s.frame = frames_[method];
    if (runs_.empty() || runs_[method]->corrected.points.empty()) return s;
    const Run& first = *runs_[method];
    metrics::MethodCurves far{s.name, {}};
    for (const auto& run : runs_) {
      if (run->method != method || run->corrected.points.empty()) continue;
      s.measured.repeats.push_back(run->measured), s.corrected.repeats.push_back(run->corrected);
      if (2 * run->lane.samples() >= first.lane.samples()) far.repeats.push_back(run->corrected);
    }
    const auto noise = reference_.noise.value_or(metrics::ReferenceNoise{});
    s.slope = metrics::slope_of(far, Abscissa::seconds, noise);
    s.slope_over_samples = metrics::slope_of(far, Abscissa::samples, noise);
    s.efficiency = metrics::efficiency_of(far);
    const auto& end = first.corrected.points.back();
    s.rmse = std::sqrt(end.mse), s.relmse = end.relmse;
    s.seconds = first.lane.seconds(), s.samples = first.lane.samples();
    s.rays_per_second = first.lane.rays_per_second();
    return s;
  }

  double progress(const LiveBenchmarkSnapshot& s) const {
    double sum = 0;
    for (const auto& run : runs_)
      sum += std::min(1.0, plan_.rule == Rule::equal_time ? run->lane.seconds() / s.seconds
                                                          : static_cast<double>(run->lane.samples()) / s.samples);
    return s.phase == Phase::done ? 1 : sum / (static_cast<double>(plan_.methods.size()) * plan_.repeats);
  }

  // Shared, under mutex_: budgets, flags and the snapshot.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  LiveBenchmarkPlan plan_;
  const std::function<void()> wake_;
  bool quit_ = false, wanted_ = true, done_ = false;
  std::atomic<bool> going_{true};  // also read by workers, without the mutex
  Phase phase_ = Phase::preparing;
  std::shared_ptr<const LiveBenchmarkSnapshot> snapshot_;

  // The thread's own.
  std::shared_ptr<const scene::CompiledScene> scene_;
  std::optional<ReferenceStore> store_;
  std::unique_ptr<TimedRender> reference_lane_;  // none for a reference that was given
  uint32_t kept_samples_ = 0;
  Reference reference_;
  std::shared_ptr<const render::Frame> reference_frame_;
  std::vector<std::unique_ptr<Run>> runs_;  // of the first repeat, method by method, then of the second
  std::vector<std::shared_ptr<const render::Frame>> frames_;  // of each method
  render::ThreadPool workers_;
  std::thread thread_;  // last: it uses everything above
};

LiveBenchmark::LiveBenchmark(LiveBenchmarkPlan plan, std::function<void()> wake)
    : impl_(std::make_unique<Impl>(std::move(plan), std::move(wake))) {}
LiveBenchmark::~LiveBenchmark() = default;
void LiveBenchmark::stop() { impl_->stop(); }
void LiveBenchmark::go_on() { impl_->go_on(); }
std::shared_ptr<const LiveBenchmarkSnapshot> LiveBenchmark::snapshot() const { return impl_->snapshot(); }

}  // namespace etendue::bench
