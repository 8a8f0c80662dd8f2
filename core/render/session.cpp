#include "render/session.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>

#include "base/hash.h"
#include "render/incompatibility.h"
#include "render/preview_resolution.h"
#include "render/renderer.h"

namespace etendue::render {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }
double milliseconds_since(Clock::time_point start) { return 1000 * seconds_since(start); }
Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

// What the first frame of an edit may take by prediction, and when it is given up for a coarser one.
constexpr double kCoarseSeconds = 0.015, kGiveUpSeconds = 0.025;
// The same for the first frame after one that the next edit cut short; for so long it is not cut.
constexpr double kOwedSeconds = 0.006, kProtectedSeconds = 0.012;
// Between two looks at what goes on where no frame comes of it, and how long a phase lasts before it is worth a word.
constexpr double kLookSeconds = 0.1, kPhaseSeconds = 0.3;

// The more samples there are, the less the next frame differs.
double frames_apart(uint32_t samples) { return samples < 32 ? 1 : samples < 256 ? 2.5 : 5; }

// Whether two documents have the same light: what differs otherwise needs no new samples.
bool same_light(const Document& a, const Document& b) {
  return a.scene == b.scene && a.camera == b.camera && a.width == b.width && a.height == b.height &&
         a.filter == b.filter && a.fireflies == b.fireflies && a.method == b.method &&
         a.forced_flags == b.forced_flags && a.seed == b.seed;
}

}  // namespace

class Session::Impl {
 public:
  explicit Impl(const SessionOptions& options)
      : options_(options),
        workers_(options.threads),
        frames_(workers_),
        shown_scene_(std::move(options_.scene)),
        thread_([this] { loop(); }) {}

  ~Impl() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
      interrupt_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  uint64_t submit(const Document& document, std::optional<ResumePoint> start) {
    const std::lock_guard lock(mutex_);
    Edit edit{document, std::move(start), ++last_version_, Clock::now(), !latest_ || !same_light(*latest_, document)};
    // An edit that was not taken up yet, and that this one replaces, still counts.
    if (pending_ && !edit.restarts) {
      edit.restarts = pending_->restarts;
      if (!edit.start) edit.start = std::move(pending_->start);
    }
    pending_ = std::move(edit);
    latest_ = document;
    stopped_ = false;
    interrupt_ = true;
    changed_.notify_all();
    return last_version_;
  }

  void restart() {
    const std::lock_guard lock(mutex_);
    if (!latest_) return;
    pending_ = Edit{*latest_, std::nullopt, ++last_version_, Clock::now(), true};
    interrupt_ = true;
    changed_.notify_all();
  }

  void pause(bool paused) {
    const std::lock_guard lock(mutex_);
    paused_ = paused;
    changed_.notify_all();
  }

  bool paused() const {
    const std::lock_guard lock(mutex_);
    return paused_;
  }

  std::shared_ptr<const Frame> frame() const {
    const std::lock_guard lock(mutex_);
    return frame_;
  }

  Status status() const {
    const std::lock_guard lock(mutex_);
    Status s = status_;
    if (paused_ && !s.finished) s.phase = "paused";
    return s;
  }

  std::shared_ptr<const scene::CompiledScene> scene() const {
    const std::lock_guard lock(mutex_);
    return shown_scene_;
  }

  transport::Model model() const {
    const std::lock_guard lock(mutex_);
    return model_;
  }

  std::vector<double> take(std::vector<double>& list) {
    const std::lock_guard lock(mutex_);
    return std::exchange(list, {});
  }

  void on_update(std::function<void()> wake) {
    const std::lock_guard lock(mutex_);
    wake_ = std::move(wake);
  }

  void finish() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [&] { return stopped_ || (!pending_ && status_.version == last_version_ && status_.finished); });
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    interrupt_ = true;
    changed_.notify_all();
    idle_.notify_all();
  }

  film::Film film_copy() {
    return between_slices([&] { return film_stale_ ? film::Film(document_.width, document_.height) : film_; });
  }

  ResumePoint resume_point() {
    return between_slices([&]() -> ResumePoint {
      if (film_stale_) return film::Film(document_.width, document_.height);
      return {film_, runner_ ? runner_->work_state() : std::vector<std::byte>()};
    });
  }

  std::optional<std::vector<float>> reweighted_copy() {
    return between_slices([&]() -> std::optional<std::vector<float>> {
      if (!cascades_ || film_stale_) return std::nullopt;
      std::vector<float> rgb;
      rgb.reserve(3 * pixel_count());
      for (int y = 0; y < film_.height(); ++y)
        for (int x = 0; x < film_.width(); ++x) {
          const Rgb c = cascades_->shown(x, y, film_.samples(x, y));
          rgb.insert(rgb.end(), {c.r, c.g, c.b});
        }
      return rgb;
    });
  }

  std::shared_ptr<const std::vector<integrator::StoredPoint>> stored_points() {
    return between_slices([&] { return runner_ ? runner_->points() : nullptr; });
  }

  std::vector<double> latencies_, restart_latencies_;

 private:
  struct Edit {
    Document document;
    std::optional<ResumePoint> start;
    uint64_t version;
    Clock::time_point submitted;
    bool restarts;
  };

  // Calls `look` while nobody writes to the film.
  template <class F>
  std::invoke_result_t<F> between_slices(F&& look) {
    std::unique_lock lock(mutex_);
    ++film_wanted_;
    interrupt_ = true;
    changed_.notify_all();
    film_free_.wait(lock, [&] { return film_idle_; });
    auto seen = look();
    --film_wanted_;
    changed_.notify_all();
    return seen;
  }

  // The session's own thread: takes up edits, renders in slices, publishes.
  void loop() {
    std::unique_lock lock(mutex_);
    while (true) {
      film_idle_ = true;
      film_free_.notify_all();
      changed_.wait(lock, [&] { return quit_ || pending_ || (film_wanted_ == 0 && can_render()); });
      if (quit_) return;
      film_idle_ = false;
      if (pending_ && !(owes_frame() && film_wanted_ == 0 && can_render())) {
        Edit edit = std::move(*pending_);
        pending_.reset();
        interrupt_ = false;
        lock.unlock();
        take_up(std::move(edit));
        lock.lock();
        continue;
      }
      interrupt_ = pending_.has_value();
      lock.unlock();
      slice();
      lock.lock();
    }
  }

  bool can_render() const { return runner_ && !paused_ && !stopped_ && !status_.finished; }

  // Edits that come faster than frames would leave the old picture standing for as long as they come: a first frame
  // after one that was cut short gets a little time of its own.
  bool owes_frame() const { return awaiting_first_frame_ && Clock::now() < protected_until_; }

  // Whether to leave off: asked by workers, between rows.
  bool cut() const { return interrupt_.load(std::memory_order_relaxed) && !owes_frame(); }

  void take_up(Edit edit) {
    if (!edit.restarts && runner_ && !edit.start) return relabel(edit);
    {
      const std::lock_guard lock(mutex_);
      restart_latencies_.push_back(milliseconds_since(edit.submitted));
      status_.phase = "compiling";
    }
    const bool owed = awaiting_first_frame_;
    submitted_ = edit.submitted;
    const auto compiled = scene::compile(edit.document.scene, edit.document.camera, shown_scene_);
    document_ = std::move(edit.document);
    film_stale_ = !edit.start;
    if (edit.start) take_over(std::move(edit.start->film));
    runner_ = std::make_unique<Renderer>(document_, compiled, document_.width, document_.height, runner_.get());
    counters_.rays = 0, counters_.paths = 0, shown_paths_ = 0;
    rendering_seconds_ = 0;
    if (!film_stale_) runner_->begin(film_, edit.start->integrator_state);
    complete_ = runner_->samples();
    error_ = {}, error_at_ = 0;
    forecast_ = TimeEstimator(find_sampler(document_.method.sampler)->independent);
    health_ = nullptr, health_at_ = 0;
    if (options_.interactive && complete_ == 0)
      pace_.begin(pixel_count(), owed ? kOwedSeconds : kCoarseSeconds);
    else
      pace_.begin_with_the_picture();
    coarse_.reset();
    awaiting_first_frame_ = options_.interactive;
    phase_ = nullptr;
    protected_until_ = owed ? Clock::now() + seconds(kProtectedSeconds) : Clock::time_point();
    const std::lock_guard lock(mutex_);
    shown_scene_ = compiled;
    model_ = runner_->model();
    status_ = Status{};
    status_.version = edit.version;
    status_.build = compiled->report();
    status_.phase = "rendering";
    status_.incompatibility = incompatibility(document_, *compiled);
    status_.samples = complete_;
    status_.memory = compiled->memory() + embree_memory() + film_bytes();
  }

  // An edit that changes no light: the picture goes on under the new version.
  void relabel(const Edit& edit) {
    const std::lock_guard lock(mutex_);
    document_ = edit.document;
    status_.version = edit.version;
    status_.finished = false;
    if (!frame_ || awaiting_first_frame_) return;
    auto same = std::make_shared<Frame>(*frame_);
    same->version = edit.version;
    frame_ = same;
  }

  // The film, and what goes along with it.
  size_t film_bytes() const {
    const size_t cascades = reweights() ? pixel_count() * film::FireflyCascades::kBytesPerPixel : 0;
    return pixel_count() * sizeof(film::Film::Pixel) + TailStatistics::memory(document_.width, document_.height) +
           cascades;
  }
  bool reweights() const { return document_.fireflies == film::Fireflies::reweight; }
  size_t pixel_count() const { return static_cast<size_t>(document_.width) * static_cast<size_t>(document_.height); }

  // Some work, then a frame if it is time for one.
  void slice() {
    if (pace_.scale() > 1) return coarse_frame();
    if (film_stale_ && !renew_film()) return;
    const auto start = Clock::now();
    // A picture small enough to do without coarse frames is first shown when it is whole.
    const bool first = awaiting_first_frame_ && complete_ == 0;
    const double allowed = first                  ? kLookSeconds
                           : options_.interactive ? options_.publish_interval * frames_apart(complete_)
                                                  : 0.25;
    const auto keep_going = [&] { return !cut() && seconds_since(start) < allowed; };
    while (!reached_limit(rendering_seconds_ + seconds_since(start))) {
      if (runner_->advance(workers_, {film_, &tails_, cascades()}, keep_going, counters_, [&] { return !cut(); }))
        complete_ = runner_->samples();
      if (first || !keep_going()) break;
    }
    const double took = seconds_since(start);
    rendering_seconds_ += took;
    if (first && complete_ > 0) pace_.note(counters_.paths, rendering_seconds_);
    const bool finished = update_status();
    // The last frame is shown even if somebody wants the film meanwhile: no slice comes after it. Nothing is new where
    // the limit was reached before: the frame that stands goes on.
    if (!options_.interactive || (cut() && !finished) || (first && complete_ == 0)) return;
    if (!awaiting_first_frame_ && counters_.paths == shown_paths_ && frame_->samples == complete_) return;
    shown_paths_ = counters_.paths;
    publish(frames_.full(film_, complete_ > 0 ? nullptr : coarse_.get(), cascades()));
  }

  // The film is emptied only here, after the coarse frames: it is too large to keep an edit waiting for it.
  bool renew_film() {
    if (film_.width() != document_.width || film_.height() != document_.height) {
      film_ = film::Film();  // gives back its memory first
      film_ = film::Film(document_.width, document_.height);
    } else if (!workers_.for_bands(
                   film_.height(), [&](int y, int end) { film_.clear_rows(y, end); }, [&] { return !cut(); })) {
      return false;
    }
    film_.set_invalid_samples({});
    if (!reset_cascades()) return false;
    film_.tile_variance().reset();
    runner_->begin(film_);
    renew_tails();
    film_stale_ = false;
    return true;
  }

  film::FireflyCascades* cascades() { return cascades_ ? &*cascades_ : nullptr; }

  bool reset_cascades() {
    if (!reweights()) return cascades_.reset(), true;
    if (!cascades_ || cascades_->width() != document_.width || cascades_->height() != document_.height) {
      cascades_.reset();
      cascades_.emplace(document_.width, document_.height);
      return true;
    }
    return workers_.for_bands(
        document_.height, [&](int y, int end) { cascades_->clear_rows(y, end); }, [&] { return !cut(); });
  }

  // Goes on with a film. Of samples that were drawn before only the means are known: what watches them starts anew, and
  // for the cascades each was as bright as its pixel.
  void take_over(film::Film&& film) {
    film_ = std::move(film);
    renew_tails();
    cascades_.reset();
    if (!reweights()) return;
    cascades_.emplace(document_.width, document_.height);
    for (int y = 0; y < film_.height(); ++y)
      for (int x = 0; x < film_.width(); ++x) cascades_->add(x, y, film_.mean(x, y), film_.samples(x, y));
  }

  void renew_tails() {
    if (tails_.width() == document_.width && tails_.height() == document_.height)
      tails_.clear();
    else
      tails_ = TailStatistics(document_.width, document_.height);
  }

  void coarse_frame() {
    const auto start = Clock::now();
    const int scale = pace_.scale(), w = std::max(1, document_.width / scale),
              h = std::max(1, document_.height / scale);
    // Under the same seed, so that photons are traced for both.
    Document small = document_;
    small.method.adaptive = Adaptive::off;
    Renderer runner(small, shown_scene_, w, h, runner_.get());
    film::Film film(w, h);
    Renderer::Counters counters;
    const bool may_give_up = awaiting_first_frame_ && !pace_.is_coarsest();
    const auto wanted = [&] { return !cut() && !(may_give_up && seconds_since(start) > kGiveUpSeconds); };
    runner.begin(film);
    bool done = false;
    while (!done && wanted()) {
      const auto slice_start = Clock::now();
      const auto keep_going = [&] { return wanted() && seconds_since(slice_start) < kLookSeconds; };
      done = runner.advance(workers_, {film}, keep_going, counters, wanted);
      const std::lock_guard lock(mutex_);
      note_phase(runner);
    }
    pace_.note(counters.paths, seconds_since(start));
    if (!done) {
      if (!cut()) pace_.cancelled();
      return;
    }
    coarse_ = frames_.coarse(film, scale);
    pace_.done();
    publish(frames_.enlarged(*coarse_, document_.width, document_.height));
  }

  void publish(std::shared_ptr<Frame> frame) {
    std::function<void()> wake;
    frame->samples = complete_;
    {
      const std::lock_guard lock(mutex_);
      frame->version = status_.version;
      frame_ = std::move(frame);
      if (awaiting_first_frame_) latencies_.push_back(milliseconds_since(submitted_));
      awaiting_first_frame_ = false;
      wake = wake_;
    }
    if (wake) wake();
  }

  bool reached_limit(double seconds) {
    const Limits& limits = document_.limits;
    if (limits.samples > 0 && complete_ >= limits.samples) return true;
    if (limits.seconds > 0 && complete_ > 0) {
      // A pass that would end later than half of itself past the limit is not begun.
      const double per_pass = seconds / complete_;
      if (seconds + 0.5 * per_pass >= limits.seconds) return true;
    }
    if (limits.rmse <= 0) return false;
    if (error_is_due()) measure_error(seconds);
    return error_.known && error_.rmse <= limits.rmse;
  }

  // Looking costs as much as a pass of a simple scene: it is done when the samples have grown by an eighth.
  bool error_is_due() const { return complete_ >= 2 && complete_ >= error_at_ + std::max(1u, error_at_ / 8); }

  // After so many seconds of rendering.
  void measure_error(double seconds) {
    std::vector<film::RowError> rows(static_cast<size_t>(film_.height()));
    const auto band = [&](int y, int end) {
      for (; y < end; ++y) rows[static_cast<size_t>(y)] = film_.error_of_row(y);
    };
    if (!workers_.for_bands(film_.height(), band, [&] { return !cut(); })) return;
    error_ = film_.error(rows), error_at_ = complete_;
    forecast_.add(complete_, seconds, error_);
  }

  // Fitting tails takes some milliseconds.
  bool health_is_due() const { return complete_ >= 10 && complete_ >= health_at_ + health_at_ / 4; }

  void measure_health() {
    std::vector<film::Tail> reports(tails_.tails().size());
    const auto band = [&](int i, int end) {
      for (; i < end; ++i) reports[static_cast<size_t>(i)] = tails_.tails()[static_cast<size_t>(i)].report();
    };
    const auto keep_going = [&] { return !cut(); };
    if (!workers_.for_bands(static_cast<int>(reports.size()), band, keep_going)) return;
    auto health = reliability_of(tails_, reports, film_.rejected(), complete_ * uint64_t{pixel_count()}, keep_going);
    if (health) health_ = std::move(health), health_at_ = complete_;
  }

  // Whether a limit was reached.
  bool update_status() {
    const bool finished = reached_limit(rendering_seconds_);
    if (error_is_due() || (finished && error_at_ != complete_)) measure_error(rendering_seconds_);
    if (health_is_due() || (finished && health_at_ != complete_)) measure_health();
    const std::lock_guard lock(mutex_);
    status_.samples = complete_;
    status_.seconds = rendering_seconds_;
    status_.rays = counters_.rays, status_.paths = counters_.paths;
    status_.rays_per_second = rendering_seconds_ > 0 ? static_cast<double>(status_.rays) / rendering_seconds_ : 0;
    status_.paths_per_second = rendering_seconds_ > 0 ? static_cast<double>(status_.paths) / rendering_seconds_ : 0;
    status_.error = error_;
    status_.rejected = film_.rejected();
    status_.statistics = runner_->statistics();
    status_.reliability = health_;
    status_.progress = progress();
    status_.time_left = left();
    status_.memory = shown_scene_->memory() + embree_memory() + film_bytes() + runner_->memory();
    note_phase(*runner_);
    status_.finished = finished;
    if (status_.finished) status_.phase = "done", status_.progress = 1, idle_.notify_all();
    return finished;
  }

  // What a method does first, where it takes long enough to be read. Under mutex_.
  void note_phase(const Renderer& runner) {
    const Renderer::Progress step = runner.progress();
    if (step.phase != phase_ || runner.samples() != phase_sample_) {
      phase_ = step.phase, phase_sample_ = runner.samples();
      phase_began_ = Clock::now();
    }
    const bool lasts = phase_ && seconds_since(phase_began_) >= kPhaseSeconds;
    status_.phase = lasts ? phase_ : "rendering";
    status_.phase_progress = lasts ? step.done : 0;
  }

  // Until the nearest limit, as far as that can be told.
  std::optional<Prediction> left() const {
    const Limits& limits = document_.limits;
    std::optional<Prediction> nearest;
    const auto take = [&](const std::optional<Prediction>& p) {
      if (p && (!nearest || p->seconds < nearest->seconds)) nearest = p;
    };
    const auto certain = [](double seconds) {
      seconds = std::max(0.0, seconds);
      return Prediction{seconds, {seconds, seconds}};
    };
    if (limits.samples > 0 && complete_ > 0)
      take(certain(rendering_seconds_ / complete_ * (static_cast<double>(limits.samples) - complete_)));
    if (limits.seconds > 0) take(certain(limits.seconds - rendering_seconds_));
    // The last look at the error was a while ago.
    if (limits.rmse > 0) take(forecast_.time_to(limits.rmse, rendering_seconds_));
    return nearest;
  }

  double progress() const {
    const Limits& limits = document_.limits;
    double most = 0;
    if (limits.samples > 0) most = std::max(most, static_cast<double>(complete_) / limits.samples);
    if (limits.seconds > 0) most = std::max(most, rendering_seconds_ / limits.seconds);
    if (limits.rmse > 0 && error_.known) most = std::max(most, sqr(limits.rmse / std::max(error_.rmse, 1e-30)));
    return std::min(most, 1.0);
  }

  SessionOptions options_;
  ThreadPool workers_;
  FrameMaker frames_;

  // Shared with callers, under mutex_.
  mutable std::mutex mutex_;
  std::condition_variable changed_, idle_, film_free_;
  std::optional<Edit> pending_;
  std::optional<Document> latest_;
  uint64_t last_version_ = 0;
  bool paused_ = false, quit_ = false, stopped_ = false, film_idle_ = true;
  int film_wanted_ = 0;
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const scene::CompiledScene> shown_scene_;
  transport::Model model_;
  Status status_;
  std::function<void()> wake_;
  std::atomic<bool> interrupt_{false};  // also read by workers, without the mutex

  // The session thread's own; document_, film_ and film_stale_ may be read by others while film_idle_.
  Document document_;
  std::unique_ptr<Renderer> runner_;
  film::Film film_;
  bool film_stale_ = false;  // it still shows what was before the last edit
  Renderer::Counters counters_;
  uint64_t shown_paths_ = 0;  // that the last frame was made of
  std::shared_ptr<const Frame> coarse_;
  uint32_t complete_ = 0;
  film::ErrorEstimate error_;
  uint32_t error_at_ = 0;  // the samples at which it was measured
  TimeEstimator forecast_;
  TailStatistics tails_;
  std::optional<film::FireflyCascades> cascades_;  // if fireflies are re-weighted
  std::shared_ptr<const Reliability> health_;
  uint32_t health_at_ = 0;  // the same
  double rendering_seconds_ = 0;
  PreviewResolution pace_;
  const char* phase_ = nullptr;  // of the sample that is being made
  uint32_t phase_sample_ = 0;
  Clock::time_point phase_began_;
  bool awaiting_first_frame_ = false;
  Clock::time_point submitted_, protected_until_;

  std::thread thread_;  // last: it uses everything above
};

Session::Session(const SessionOptions& options) : impl_(std::make_unique<Impl>(options)) {}
Session::~Session() = default;
uint64_t Session::submit(const Document& document) { return impl_->submit(document, std::nullopt); }
uint64_t Session::submit(const Document& document, ResumePoint start) {
  return impl_->submit(document, std::move(start));
}
void Session::restart() { impl_->restart(); }
void Session::pause(bool paused) { impl_->pause(paused); }
bool Session::paused() const { return impl_->paused(); }
std::shared_ptr<const Frame> Session::frame() const { return impl_->frame(); }
Status Session::status() const { return impl_->status(); }
std::shared_ptr<const scene::CompiledScene> Session::scene() const { return impl_->scene(); }
transport::Model Session::model() const { return impl_->model(); }
std::vector<double> Session::take_latencies() { return impl_->take(impl_->latencies_); }
std::vector<double> Session::take_restart_latencies() { return impl_->take(impl_->restart_latencies_); }
void Session::on_update(std::function<void()> wake) { impl_->on_update(std::move(wake)); }
void Session::finish() { impl_->finish(); }
void Session::stop() { impl_->stop(); }
film::Film Session::film_copy() { return impl_->film_copy(); }
ResumePoint Session::resume_point() { return impl_->resume_point(); }
std::optional<std::vector<float>> Session::reweighted_copy() { return impl_->reweighted_copy(); }
std::shared_ptr<const std::vector<integrator::StoredPoint>> Session::stored_points() { return impl_->stored_points(); }

film::Film rendered(const Document& document, uint32_t samples, int threads) {
  Document limited = document;
  limited.limits = {samples, 0, 0};
  SessionOptions options;
  options.threads = threads;
  Session session(options);
  session.submit(limited);
  session.finish();
  return session.film_copy();
}

}  // namespace etendue::render
