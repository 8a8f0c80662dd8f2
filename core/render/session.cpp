#include "render/session.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "base/hash.h"
#include "render/pass.h"

namespace etendue::render {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }
double milliseconds_since(Clock::time_point start) { return 1000 * seconds_since(start); }

// The longest that a coarse frame may take, so that a camera that moves is followed.
constexpr double kCoarseSeconds = 0.02;
constexpr int kCoarsest = 16;

// Whether two documents have the same light: what differs otherwise needs no new samples.
bool same_light(const Document& a, const Document& b) {
  return a.scene == b.scene && a.camera == b.camera && a.width == b.width && a.height == b.height &&
         a.filter == b.filter && a.method == b.method && a.forced_flags == b.forced_flags && a.seed == b.seed;
}

}  // namespace

class Session::Impl {
 public:
  explicit Impl(const SessionOptions& options)
      : options_(options), workers_(options.threads), thread_([this] { loop(); }) {}

  ~Impl() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
      interrupt_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  uint64_t submit(const Document& document, std::optional<film::Film> start) {
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
    std::unique_lock lock(mutex_);
    ++film_wanted_;
    interrupt_ = true;
    changed_.notify_all();
    film_free_.wait(lock, [&] { return film_idle_; });
    film::Film copy = film_;
    --film_wanted_;
    changed_.notify_all();
    return copy;
  }

  std::vector<double> latencies_, restart_latencies_;

 private:
  struct Edit {
    Document document;
    std::optional<film::Film> start;
    uint64_t version;
    Clock::time_point submitted;
    bool restarts;
  };

  // The session's own thread: takes up edits, renders in slices, publishes.
  void loop() {
    std::unique_lock lock(mutex_);
    while (true) {
      film_idle_ = true;
      film_free_.notify_all();
      changed_.wait(lock, [&] { return quit_ || pending_ || (film_wanted_ == 0 && can_render()); });
      if (quit_) return;
      film_idle_ = false;
      if (pending_) {
        Edit edit = std::move(*pending_);
        pending_.reset();
        interrupt_ = false;
        lock.unlock();
        take_up(std::move(edit));
        lock.lock();
        continue;
      }
      interrupt_ = false;
      lock.unlock();
      slice();
      lock.lock();
    }
  }

  bool can_render() const { return runner_ && !paused_ && !stopped_ && !status_.finished; }

  void take_up(Edit edit) {
    submitted_ = edit.submitted;
    if (!edit.restarts && runner_ && !edit.start) {
      const std::lock_guard lock(mutex_);
      document_ = edit.document;
      status_.version = edit.version;
      status_.finished = false;
      awaiting_first_frame_ = false;
      if (frame_) {
        auto same = std::make_shared<Frame>(*frame_);
        same->version = edit.version;
        frame_ = same;
      }
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      restart_latencies_.push_back(milliseconds_since(edit.submitted));
      status_.phase = "compiling";
    }
    const auto compiled = scene::compile(edit.document.scene, edit.document.camera, shown_scene_);
    document_ = std::move(edit.document);
    film_ = edit.start ? std::move(*edit.start) : film::Film(document_.width, document_.height);
    runner_ = std::make_unique<PassRunner>(document_, compiled, document_.width, document_.height);
    counters_.rays = 0, counters_.paths = 0;
    rendering_seconds_ = 0;
    complete_ = least_samples();
    coarse_scale_ = options_.interactive && complete_ == 0 ? first_scale() : 1;
    coarse_.reset();
    awaiting_first_frame_ = true;
    const std::lock_guard lock(mutex_);
    shown_scene_ = compiled;
    model_ = runner_->model();
    status_ = Status{};
    status_.version = edit.version;
    status_.build = compiled->report();
    status_.phase = "rendering";
    status_.samples = complete_;
    status_.memory = compiled->memory() + embree_memory();
  }

  uint32_t least_samples() const {
    uint32_t least = UINT32_MAX;
    for (const auto& p : film_.pixels()) least = std::min(least, p.count[0] + p.count[1]);
    return least;
  }

  // The finest scale at which a whole frame is expected to be done in time.
  int first_scale() const {
    const double pixels = static_cast<double>(document_.width) * document_.height;
    if (paths_per_second_ <= 0) return kCoarsest;
    int scale = 1;
    while (scale < kCoarsest && pixels / (scale * scale) > paths_per_second_ * kCoarseSeconds) scale *= 2;
    return scale;
  }

  // Some work, then a frame if it is time for one.
  void slice() {
    const auto start = Clock::now();
    if (coarse_scale_ > 1) {
      coarse_frame();
      return;
    }
    const double allowed = options_.interactive ? options_.publish_interval : 0.25;
    const auto keep_going = [&] {
      return !interrupt_.load(std::memory_order_relaxed) && seconds_since(start) < allowed;
    };
    const uint64_t before = counters_.paths;
    while (!reached_limit(rendering_seconds_ + seconds_since(start))) {
      if (runner_->run(workers_, film_, complete_ + 1, keep_going, counters_)) ++complete_;
      if (!keep_going()) break;
    }
    const double took = seconds_since(start);
    rendering_seconds_ += took;
    if (took > 0.002) paths_per_second_ = static_cast<double>(counters_.paths - before) / took;
    update_status();
    if (options_.interactive && !superseded()) publish(full_frame());
  }

  bool superseded() const {
    const std::lock_guard lock(mutex_);
    return pending_.has_value();
  }

  void coarse_frame() {
    const auto start = Clock::now();
    const int w = std::max(1, document_.width / coarse_scale_), h = std::max(1, document_.height / coarse_scale_);
    Document small = document_;
    small.seed = mix_bits(document_.seed + 0x9e3779b97f4a7c15ULL * static_cast<uint64_t>(coarse_scale_));
    PassRunner runner(small, shown_scene_, w, h);
    film::Film film(w, h);
    PassRunner::Counters counters;
    const auto keep_going = [&] { return !interrupt_.load(std::memory_order_relaxed); };
    const bool done = runner.run(workers_, film, 1, keep_going, counters);
    if (!done) return;
    const double took = std::max(1e-6, seconds_since(start));
    paths_per_second_ = static_cast<double>(counters.paths) / took;
    auto frame = std::make_shared<Frame>();
    frame->width = w, frame->height = h, frame->coarseness = coarse_scale_;
    frame->pixels.resize(static_cast<size_t>(w) * static_cast<size_t>(h));
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        frame->pixels[static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x)] = film.mean(x, y);
    frame->version = status_.version;
    coarse_ = frame;
    // Two steps finer each time; the last step is the film itself.
    coarse_scale_ = coarse_scale_ > 4 ? coarse_scale_ / 4 : 1;
    publish(enlarged(*frame));
  }

  std::shared_ptr<Frame> enlarged(const Frame& coarse) const {
    auto frame = std::make_shared<Frame>();
    frame->width = document_.width, frame->height = document_.height;
    frame->coarseness = coarse.coarseness, frame->version = coarse.version;
    frame->pixels.resize(static_cast<size_t>(frame->width) * static_cast<size_t>(frame->height));
    for (int y = 0; y < frame->height; ++y)
      for (int x = 0; x < frame->width; ++x)
        frame->pixels[static_cast<size_t>(y) * static_cast<size_t>(frame->width) + static_cast<size_t>(x)] =
            coarse_at(coarse, x, y);
    return frame;
  }

  static Rgb coarse_at(const Frame& coarse, int x, int y) {
    const int cx = std::min(x / coarse.coarseness, coarse.width - 1),
              cy = std::min(y / coarse.coarseness, coarse.height - 1);
    return coarse.pixels[static_cast<size_t>(cy) * static_cast<size_t>(coarse.width) + static_cast<size_t>(cx)];
  }

  // The film where it has samples, the coarse frame (or the old picture of this version) where it has none yet.
  std::shared_ptr<Frame> full_frame() const {
    auto frame = std::make_shared<Frame>();
    frame->width = document_.width, frame->height = document_.height;
    frame->version = status_.version;
    frame->samples = complete_;
    frame->coarseness = complete_ > 0 || !coarse_ ? 1 : coarse_->coarseness;
    frame->pixels.resize(static_cast<size_t>(frame->width) * static_cast<size_t>(frame->height));
    for (int y = 0; y < frame->height; ++y)
      for (int x = 0; x < frame->width; ++x)
        frame->pixels[static_cast<size_t>(y) * static_cast<size_t>(frame->width) + static_cast<size_t>(x)] =
            film_.samples(x, y) > 0 || !coarse_ ? film_.mean(x, y) : coarse_at(*coarse_, x, y);
    return frame;
  }

  void publish(std::shared_ptr<Frame> frame) {
    std::function<void()> wake;
    {
      const std::lock_guard lock(mutex_);
      frame_ = std::move(frame);
      if (awaiting_first_frame_) latencies_.push_back(milliseconds_since(submitted_));
      awaiting_first_frame_ = false;
      wake = wake_;
    }
    if (wake) wake();
  }

  bool reached_limit(double seconds) const {
    const Limits& limits = document_.limits;
    if (limits.samples > 0 && complete_ >= limits.samples) return true;
    if (limits.seconds > 0 && complete_ > 0) {
      // A pass that would end later than half of itself past the limit is not begun.
      const double per_pass = seconds / complete_;
      if (seconds + 0.5 * per_pass >= limits.seconds) return true;
    }
    return limits.rmse > 0 && complete_ >= 2 && complete_ != checked_at_ && below_error(limits.rmse);
  }

  // Looking costs as much as a pass of a simple scene: it is done when the samples have grown by an eighth.
  bool below_error(double rmse) const {
    if (checked_at_ != 0 && checked_at_ < complete_ && complete_ < checked_at_ + std::max(1u, checked_at_ / 8))
      return false;
    checked_at_ = complete_;
    const auto error = film_.error();
    return error.known && error.rmse <= rmse;
  }

  void update_status() {
    const bool show_error = options_.interactive || complete_ >= 2;
    const auto error = show_error && complete_ >= 2 ? film_.error() : film::ErrorEstimate{};
    const std::lock_guard lock(mutex_);
    status_.samples = complete_;
    status_.seconds = rendering_seconds_;
    status_.rays = counters_.rays, status_.paths = counters_.paths;
    status_.rays_per_second = rendering_seconds_ > 0 ? static_cast<double>(status_.rays) / rendering_seconds_ : 0;
    status_.paths_per_second = rendering_seconds_ > 0 ? static_cast<double>(status_.paths) / rendering_seconds_ : 0;
    status_.error = error;
    status_.rejected = film_.rejected();
    status_.progress = progress();
    status_.finished = reached_limit(rendering_seconds_) ||
                       (document_.limits.rmse > 0 && error.known && error.rmse <= document_.limits.rmse);
    if (status_.finished) status_.phase = "done", status_.progress = 1, idle_.notify_all();
  }

  double progress() const {
    const Limits& limits = document_.limits;
    double most = 0;
    if (limits.samples > 0) most = std::max(most, static_cast<double>(complete_) / limits.samples);
    if (limits.seconds > 0) most = std::max(most, rendering_seconds_ / limits.seconds);
    if (limits.rmse > 0 && status_.error.known)
      most = std::max(most, sqr(limits.rmse / std::max(status_.error.rmse, 1e-30)));
    return std::min(most, 1.0);
  }

  const SessionOptions options_;
  Workers workers_;

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

  // The session thread's own; film_ may be read by others while film_idle_.
  Document document_;
  std::unique_ptr<PassRunner> runner_;
  film::Film film_;
  PassRunner::Counters counters_;
  std::shared_ptr<const Frame> coarse_;
  uint32_t complete_ = 0;
  mutable uint32_t checked_at_ = 0;
  double rendering_seconds_ = 0, paths_per_second_ = 0;
  int coarse_scale_ = 1;
  bool awaiting_first_frame_ = false;
  Clock::time_point submitted_;

  std::thread thread_;  // last: it uses everything above
};

Session::Session(const SessionOptions& options) : impl_(std::make_unique<Impl>(options)) {}
Session::~Session() = default;
uint64_t Session::submit(const Document& document) { return impl_->submit(document, std::nullopt); }
uint64_t Session::submit(const Document& document, film::Film start) {
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

}  // namespace etendue::render
