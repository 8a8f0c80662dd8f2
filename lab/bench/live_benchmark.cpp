#include "bench/live_benchmark.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "bench/denoised_images.h"
#include "bench/measurement_schedule.h"
#include "bench/timed_render.h"
#include "film/film_image.h"
#include "render/incompatibility.h"

namespace etendue::bench {
namespace {

using metrics::Abscissa;
using Phase = LiveBenchmarkSnapshot::Phase;

constexpr double kTimeSlice = 0.33;  // seconds
// The reference used for measurements is updated when its sample count has grown by 1 / kReferenceGrowth.
constexpr uint32_t kReferenceGrowth = 16;

std::shared_ptr<const render::Frame> frame_of(std::span<const float> rgb, int width, int height, uint32_t samples) {
  std::vector<Rgb> pixels(rgb.size() / 3);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
  auto frame = std::make_shared<render::Frame>();
  frame->width = width;
  frame->height = height;
  frame->pixels = std::make_shared<const std::vector<Rgb>>(std::move(pixels));
  frame->samples = samples;
  return frame;
}

// One repeat of one method, and its measurements.
struct Repeat {
  Repeat(size_t m, int repeat, const render::Document& d, const std::shared_ptr<const scene::CompiledScene>& scene)
      : method(m), rendering(d, scene), measured{repeat, {}}, corrected{repeat, {}} {}

  bool is_scheduled() const { return rendering.samples() >= next_measurement; }
  // Of rendering and of one denoised image, if the method has one.
  double seconds() const { return rendering.seconds() + (denoised ? denoised->seconds() : 0); }

  void add(const metrics::ErrorPoint& point, const metrics::ReferenceNoise& noise) {
    // A point between two scheduled sample counts only shows the current state; the next one replaces it.
    if (!measured.points.empty() && !is_last_point_scheduled) {
      measured.points.pop_back();
      corrected.points.pop_back();
    }
    measured.points.push_back(point);
    corrected.points.push_back(metrics::without_noise(point, noise));
    is_last_point_scheduled = is_scheduled();
    while (next_measurement <= rendering.samples()) next_measurement = next_sample_count(next_measurement);
  }

  size_t method;
  TimedRender rendering;
  std::optional<DenoisedImages> denoised;  // of a method that is measured with them
  metrics::ErrorCurve measured, corrected;
  uint32_t next_measurement = 1;  // the sample count of the next scheduled point
  bool is_last_point_scheduled = false;
  bool is_measurement_due = false;  // also after an interruption of the denoiser
};

}  // namespace

class LiveBenchmark::Impl {
 public:
  Impl(LiveBenchmarkPlan plan, std::function<void()> wake)
      : plan_(std::move(plan)), wake_(std::move(wake)), frames_(plan_.methods.size()), incompatibilities_(plan_.methods.size()), workers_(plan_.threads) {
    const auto& d = plan_.methods.front().document;
    const size_t film = static_cast<size_t>(d.width) * static_cast<size_t>(d.height) * sizeof(film::Film::Pixel);
    const auto max_repeats = static_cast<int>(std::min<size_t>(kMaxFilmBytes / (film * plan_.methods.size()), 10000));
    plan_.repeats = std::clamp(plan_.repeats, 1, std::max(max_repeats, 1));
    publish();
    thread_ = std::thread([this] { loop(); });
  }

  ~Impl() {
    command([this] { quit_ = true; });
    thread_.join();
  }

  void stop() {
    command([this] { should_run_ = false; });
  }

  void resume() {
    command([this] {
      if (done_) {
        plan_.seconds *= 2;
        plan_.samples *= 2;
      }
      done_ = false;
      should_run_ = true;
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
      running_ = should_run_ && !quit_;
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
      const bool running = running_;
      const bool rendered = running && render_next(seconds, samples);
      if (!rendered) save_reference();
      lock.lock();
      done_ = running && !rendered;
      phase_ = done_ ? Phase::done : running ? Phase::comparing : Phase::stopped;
      lock.unlock();
      publish();
      if (wake_) wake_();
      lock.lock();
      changed_.wait(lock, [&] { return quit_ || phase_ == Phase::comparing || (should_run_ && !done_); });
    }
    save_reference();
  }

  bool keep_going() const { return running_.load(std::memory_order_relaxed); }

  void prepare() {
    const auto& d = plan_.methods.front().document;
    scene_ = scene::compile(d.scene, d.camera, plan_.compiled, d.height);
    for (size_t m = 0; m < plan_.methods.size(); ++m)
      incompatibilities_[m] = render::incompatibility(plan_.methods[m].document, *scene_);
    if (plan_.reference) return set_reference(std::move(*plan_.reference));
    store_.emplace(d, plan_.cache);
    auto cached = store_->load();
    reference_render_ =
        std::make_unique<TimedRender>(store_->document(), scene_, std::move(cached.film), cached.seconds);
    saved_samples_ = reference_render_->samples();
    if (saved_samples_ >= film::kHalfBuffers) update_reference();
  }

  // Renders one time slice of the reference or of a method; false if all repeats have used their budget.
  bool render_next(double seconds, uint32_t samples) {
    if (is_reference_next()) {
      render_reference_slice();
      return true;
    }
    Repeat* repeat = next_repeat(seconds, samples);
    if (!repeat && static_cast<int>(repeats_.size() / plan_.methods.size()) < plan_.repeats) {
      start_repeats();
      repeat = next_repeat(seconds, samples);
    }
    if (!repeat) return false;
    const bool timed = plan_.rule == Rule::equal_time;
    TimedRender& rendering = repeat->rendering;
    const double slice = timed ? std::min(kTimeSlice, seconds - repeat->seconds()) : kTimeSlice;
    const uint32_t before = rendering.samples();
    const uint32_t target = timed ? repeat->next_measurement : std::min(repeat->next_measurement, samples);
    rendering.run(workers_, target, slice, [&] { return keep_going(); });
    // Denoised images take too long to be measured after every slice.
    const bool is_point = !repeat->denoised || repeat->is_scheduled() || is_complete(*repeat, seconds, samples);
    repeat->is_measurement_due |= rendering.samples() > before && is_point;
    if (repeat->is_measurement_due) measure(*repeat);
    return true;
  }

  // The reference has had less time than all methods together.
  bool is_reference_next() const {
    if (!reference_render_) return false;
    if (reference_render_->samples() < film::kHalfBuffers) return true;
    double methods = 0;
    for (const auto& repeat : repeats_) methods += repeat->rendering.seconds();
    return reference_render_->seconds() < methods;
  }

  // The first slice lasts until both half-buffers have a sample, so that the error of the reference is known.
  void render_reference_slice() {
    TimedRender& rendering = *reference_render_;
    const bool first = rendering.samples() < film::kHalfBuffers;
    rendering.run(workers_, first ? film::kHalfBuffers : UINT32_MAX, first ? 1e9 : kTimeSlice,
                  [&] { return keep_going(); });
    if (rendering.samples() >=
        std::max(film::kHalfBuffers, reference_.samples + reference_.samples / kReferenceGrowth + 1))
      update_reference();
  }

  void update_reference() {
    set_reference(store_->reference_of(reference_render_->film(), reference_render_->seconds()));
  }

  void set_reference(Reference reference) {
    reference_ = std::move(reference);
    set_display(reference_, plan_.methods.front().document.display.transform());
    const auto& image = reference_.image;
    reference_frame_ = frame_of(reference_.rgb(), image.width, image.height, reference_.samples);
  }

  bool is_complete(const Repeat& repeat, double seconds, uint32_t samples) const {
    if (plan_.rule == Rule::equal_samples) return repeat.rendering.samples() >= samples;
    return repeat.rendering.has_reached(seconds - (repeat.seconds() - repeat.rendering.seconds()));
  }

  // The repeat that has used least of its budget, among those with budget left; null if there is none.
  Repeat* next_repeat(double seconds, uint32_t samples) {
    const bool timed = plan_.rule == Rule::equal_time;
    const auto used = [&](const Repeat& repeat) { return timed ? repeat.seconds() : repeat.rendering.samples(); };
    Repeat* next = nullptr;
    for (const auto& repeat : repeats_) {
      if (!incompatibilities_[repeat->method].empty()) continue;
      const bool done = is_complete(*repeat, seconds, samples) && !repeat->is_measurement_due;
      if (!done && (!next || used(*repeat) < used(*next))) next = repeat.get();
    }
    return next;
  }

  // Starts the next repeat of every method.
  void start_repeats() {
    const auto index = static_cast<int>(repeats_.size() / plan_.methods.size());
    for (size_t m = 0; m < plan_.methods.size(); ++m) {
      render::Document d = plan_.methods[m].document;
      d.seed = repeat_seed(plan_.seed, m, index);
      repeats_.push_back(std::make_unique<Repeat>(m, index, d, scene_));
      if (const auto denoiser = plan_.methods[m].denoiser) {
        repeats_.back()->denoised.emplace(d, *denoiser, plan_.threads);
        repeats_.back()->next_measurement = kFirstDenoisedSamples;
      }
    }
  }

  void measure(Repeat& repeat) {
    const TimedRender& rendering = repeat.rendering;
    const auto image = repeat.denoised ? repeat.denoised->of(*scene_, rendering.film(), [&] { return keep_going(); })
                                       : film::radiance_of(rendering.film());
    if (!image) incompatibilities_[repeat.method] = image.error().message;
    if (!image || image->empty()) return;
    repeat.is_measurement_due = false;
    repeat.add(measure_error(*image, reference_, repeat.seconds(), rendering.samples()),
               reference_.noise.value_or(metrics::ReferenceNoise{}));
    const auto& film = rendering.film();
    if (repeat.measured.repeat == 0)
      frames_[repeat.method] = frame_of(*image, film.width(), film.height(), rendering.samples());
  }

  // Saves the reference if it has more samples than the cached one.
  void save_reference() {
    if (!reference_render_ || reference_render_->samples() <= saved_samples_) return;
    saved_samples_ = reference_render_->samples();
    store_->save(reference_render_->film(), reference_render_->seconds());
  }

  void publish() {
    auto s = std::make_shared<LiveBenchmarkSnapshot>();
    {
      const std::lock_guard lock(mutex_);
      s->phase = phase_;
      s->seconds = plan_.seconds;
      s->samples = plan_.samples;
    }
    s->rule = plan_.rule;
    s->repeats = plan_.repeats;
    s->repeat = static_cast<int>(repeats_.size() / plan_.methods.size());
    s->reference = reference_frame_;
    s->reference_error = reference_.standard_error();
    s->reference_noise = reference_.noise;
    s->reference_samples = reference_render_ ? reference_render_->samples() : reference_.samples;
    s->reference_seconds = reference_render_ ? reference_render_->seconds() : reference_.seconds;
    for (size_t m = 0; m < plan_.methods.size(); ++m) {
      s->methods.push_back(method_status(m));
      s->too_noisy = s->too_noisy || (reference_.noise &&
                                      metrics::is_reference_too_noisy(s->methods.back().corrected, *reference_.noise));
    }
    s->progress = progress(*s);
    const std::lock_guard lock(mutex_);
    snapshot_ = std::move(s);
  }

  MethodStatus method_status(size_t method) const {
    MethodStatus s;
    s.name = s.measured.name = s.corrected.name = plan_.methods[method].name;
    s.incompatibility = incompatibilities_[method];
    s.frame = frames_[method];
    if (repeats_.empty() || repeats_[method]->corrected.points.empty()) return s;
    const Repeat& first = *repeats_[method];
    metrics::MethodCurves advanced{s.name, {}};  // repeats with at least half as many samples as the first
    for (const auto& repeat : repeats_) {
      if (repeat->method != method || repeat->corrected.points.empty()) continue;
      s.measured.repeats.push_back(repeat->measured);
      s.corrected.repeats.push_back(repeat->corrected);
      if (2 * repeat->rendering.samples() >= first.rendering.samples()) advanced.repeats.push_back(repeat->corrected);
    }
    const auto noise = reference_.noise.value_or(metrics::ReferenceNoise{});
    s.slope = metrics::slope_of(advanced, Abscissa::seconds, noise);
    s.slope_over_samples = metrics::slope_of(advanced, Abscissa::samples, noise);
    s.efficiency = metrics::efficiency_of(advanced);
    const auto& end = first.corrected.points.back();
    s.rmse = std::sqrt(end.mse);
    s.relmse = end.relmse;
    s.seconds = first.seconds();
    s.samples = first.rendering.samples();
    s.rays_per_second = first.rendering.rays_per_second();
    return s;
  }

  double progress(const LiveBenchmarkSnapshot& s) const {
    double sum = 0;
    for (const auto& repeat : repeats_)
      sum += !incompatibilities_[repeat->method].empty()
                 ? 1
                 : std::min(1.0, plan_.rule == Rule::equal_time
                                     ? repeat->seconds() / s.seconds
                                     : static_cast<double>(repeat->rendering.samples()) / s.samples);
    return s.phase == Phase::done ? 1 : sum / (static_cast<double>(plan_.methods.size()) * plan_.repeats);
  }

  // Shared between threads, guarded by mutex_.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  LiveBenchmarkPlan plan_;
  const std::function<void()> wake_;
  bool quit_ = false, should_run_ = true, done_ = false;
  std::atomic<bool> running_{true};  // also read by workers, without the mutex
  Phase phase_ = Phase::preparing;
  std::shared_ptr<const LiveBenchmarkSnapshot> snapshot_;

  // Used by thread_ only.
  std::shared_ptr<const scene::CompiledScene> scene_;
  std::optional<ReferenceStore> store_;
  std::unique_ptr<TimedRender> reference_render_;  // null if the plan contains a reference
  uint32_t saved_samples_ = 0;
  Reference reference_;
  std::shared_ptr<const render::Frame> reference_frame_;
  std::vector<std::unique_ptr<Repeat>> repeats_;              // the first repeats of all methods, then the second ones
  std::vector<std::shared_ptr<const render::Frame>> frames_;  // one per method
  std::vector<std::string> incompatibilities_;                // one per method
  render::ThreadPool workers_;
  std::thread thread_;  // last member, because it uses all others
};

LiveBenchmark::LiveBenchmark(LiveBenchmarkPlan plan, std::function<void()> wake)
    : impl_(std::make_unique<Impl>(std::move(plan), std::move(wake))) {}
LiveBenchmark::~LiveBenchmark() = default;
void LiveBenchmark::stop() { impl_->stop(); }
void LiveBenchmark::resume() { impl_->resume(); }
std::shared_ptr<const LiveBenchmarkSnapshot> LiveBenchmark::snapshot() const { return impl_->snapshot(); }

}  // namespace etendue::bench
