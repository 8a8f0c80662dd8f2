#include "render/session.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>

#include "render/edit_queue.h"
#include "render/progressive_render.h"
#include "render/shared_sampling.h"

namespace etendue::render {
namespace {

// The planned time from an edit to its first frame, in seconds, and the least part of it for the rendering of the preview.
constexpr double kFirstFrameSeconds = 0.014, kLeastPreviewSeconds = 0.004;
// The planned duration of the rendering of the first frame of an edit that follows an edit without any frame, and the time
// during which such a frame cannot be interrupted.
constexpr double kProtectedPreviewSeconds = 0.006, kProtectedSeconds = 0.012;

}  // namespace

class Session::Impl {
 public:
  explicit Impl(const SessionOptions& options)
      : workers_(options.threads),
        sharing_(options.sharing),
        compiled_scene_(options.scene),
        render_(workers_, options, [this] { return !is_interrupted(); }),
        thread_([this] { run(); }) {}

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
    const uint64_t version = edits_.submit(document, std::move(start));
    stopped_ = false;
    update_sharing();
    interrupt();
    return version;
  }

  uint64_t restart() {
    const std::lock_guard lock(mutex_);
    if (edits_.resubmit()) interrupt();
    return edits_.last_version();
  }

  void pause(bool paused) {
    const std::lock_guard lock(mutex_);
    paused_ = paused;
    update_sharing();
    changed_.notify_all();
  }

  bool paused() const {
    const std::lock_guard lock(mutex_);
    return paused_;
  }

  void set_focus(const std::optional<PixelRect>& region) {
    const std::lock_guard lock(mutex_);
    if (focus_ == region) return;
    focus_ = region;
    status_.finished = false;
    interrupt();
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
    return compiled_scene_;
  }

  transport::Model model() const {
    const std::lock_guard lock(mutex_);
    return model_;
  }

  std::vector<double> take_latencies() {
    const std::lock_guard lock(mutex_);
    return std::exchange(latencies_, {});
  }

  std::vector<double> take_restart_latencies() {
    const std::lock_guard lock(mutex_);
    return std::exchange(restart_latencies_, {});
  }

  void on_update(std::function<void()> wake) {
    const std::lock_guard lock(mutex_);
    wake_ = std::move(wake);
  }

  void finish() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [&] {
      return stopped_ || (edits_.empty() && status_.version == edits_.last_version() && status_.finished);
    });
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    update_sharing();
    interrupt();
    idle_.notify_all();
  }

  // Calls `copy(render)` while the session's thread does not touch the render.
  template <class F>
  std::invoke_result_t<F, const ProgressiveRender&> between_slices(F&& copy) {
    std::unique_lock lock(mutex_);
    ++waiting_copies_;
    interrupt();
    render_free_.wait(lock, [&] { return render_is_free_; });
    auto result = copy(std::as_const(render_));
    --waiting_copies_;
    changed_.notify_all();
    return result;
  }

 private:
  // Ends the current slice and wakes up the session's thread. Under mutex_.
  void interrupt() {
    interrupt_ = true;
    changed_.notify_all();
  }

  // Other processes render while the session does. Under mutex_.
  void update_sharing() {
    if (sharing_) sharing_->hold(paused_ || stopped_ || status_.finished);
  }

  // The session's thread: takes up edits, renders slices, publishes frames.
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      render_is_free_ = true;
      render_free_.notify_all();
      changed_.wait(lock, [&] { return quit_ || !edits_.empty() || (waiting_copies_ == 0 && can_render()); });
      if (quit_) return;
      render_is_free_ = false;
      if (!edits_.empty() && !(first_frame_is_protected() && waiting_copies_ == 0 && can_render())) {
        Edit edit = edits_.take();
        interrupt_ = false;
        lock.unlock();
        take_up(std::move(edit));
        lock.lock();
        continue;
      }
      interrupt_ = !edits_.empty();
      const auto focus = focus_;
      lock.unlock();
      render_.set_focus(focus);
      render_slice(focus);
      lock.lock();
    }
  }

  bool can_render() const { return render_.has_begun() && !paused_ && !stopped_ && !status_.finished; }

  // Edits that arrive faster than frames would leave the old image on screen. The first frame after an edit that was
  // interrupted without any frame is therefore protected for a short time.
  bool first_frame_is_protected() const { return render_.awaits_first_frame() && Clock::now() < protected_until_; }

  // Called by the workers between tasks.
  bool is_interrupted() const { return interrupt_.load(std::memory_order_relaxed) && !first_frame_is_protected(); }

  void take_up(Edit edit) {
    if (!edit.restarts && render_.has_begun() && !edit.start) return relabel(edit);
    {
      const std::lock_guard lock(mutex_);
      restart_latencies_.push_back(1000 * seconds_since(edit.submitted));
      status_.phase = "compiling";
    }
    const Clock::time_point start = Clock::now();
    const bool protects_first_frame = render_.awaits_first_frame();
    submitted_ = edit.submitted;
    const bool shares = begin_sharing(edit);
    const auto compiled =
        scene::compile(edit.document.scene, edit.document.camera, compiled_scene_, edit.document.height);
    const double time_left =
        kFirstFrameSeconds - seconds_since(edit.submitted) - render_.enlarging_seconds(edit.document);
    const double preview_seconds =
        protects_first_frame ? kProtectedPreviewSeconds : std::max(kLeastPreviewSeconds, time_left);
    render_.begin(std::move(edit.document), compiled, std::move(edit.start), preview_seconds, shares);
    // Not shorter than the preparation: it would be in vain.
    const double protected_seconds = std::max(kProtectedSeconds, seconds_since(start));
    protected_until_ = protects_first_frame ? Clock::now() + duration_of(protected_seconds) : Clock::time_point();
    const std::lock_guard lock(mutex_);
    compiled_scene_ = compiled;
    model_ = render_.model();
    status_ = Status{};
    status_.version = edit.version;
    render_.write_initial_status(status_);
    update_sharing();
  }

  // Before the scene is compiled, so that other processes stop rendering the previous document at once.
  bool begin_sharing(const Edit& edit) {
    if (!sharing_) return false;
    if (!edit.start) return sharing_->begin(edit.document);
    sharing_->end();
    return false;
  }

  // Takes up an edit that leaves the samples valid: the image continues under the new version.
  void relabel(const Edit& edit) {
    const std::lock_guard lock(mutex_);
    render_.set_document(edit.document);
    status_.version = edit.version;
    status_.finished = false;
    if (sharing_) sharing_->set_limit(edit.document.limits.samples);
    update_sharing();
    if (!frame_ || render_.awaits_first_frame()) return;
    auto frame = std::make_shared<Frame>(*frame_);
    frame->version = edit.version;
    frame_ = std::move(frame);
  }

  // `focus` is that of the slice. If it has been changed since, limits may not have been reached.
  void render_slice(const std::optional<PixelRect>& focus) {
    if (render_.needs_preview()) {
      const auto write_phase = [&](const Renderer& renderer) {
        const std::lock_guard lock(mutex_);
        render_.write_phase(status_, renderer);
      };
      publish(render_.render_preview(write_phase, [&](std::shared_ptr<Frame> frame) { publish(std::move(frame)); }));
      return;
    }
    if (!render_.render_slice()) return;
    bool finished = render_.update_statistics();
    {
      const std::lock_guard lock(mutex_);
      finished = finished && focus_ == focus;
      render_.write_status(status_, finished);
      update_sharing();
      if (finished) idle_.notify_all();
    }
    publish(render_.frame_after_slice(finished));
  }

  void publish(std::shared_ptr<Frame> frame) {
    if (!frame) return;
    std::function<void()> wake;
    {
      const std::lock_guard lock(mutex_);
      frame->version = status_.version;
      frame_ = std::move(frame);
      if (render_.awaits_first_frame()) latencies_.push_back(1000 * seconds_since(submitted_));
      render_.first_frame_shown();
      wake = wake_;
    }
    if (wake) wake();
  }

  ThreadPool workers_;
  SharedSampling* const sharing_;  // null: none

  // Shared with callers, under mutex_.
  mutable std::mutex mutex_;
  std::condition_variable changed_, idle_, render_free_;
  EditQueue edits_;
  std::optional<PixelRect> focus_;
  bool paused_ = false, quit_ = false, stopped_ = false;
  bool render_is_free_ = true;  // the session's thread does not use render_
  int waiting_copies_ = 0;      // callers that wait for render_is_free_
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const scene::CompiledScene> compiled_scene_;
  transport::Model model_;
  Status status_;
  std::function<void()> wake_;
  std::vector<double> latencies_, restart_latencies_;
  std::atomic<bool> interrupt_{false};  // also read by workers, without the mutex

  // Used by the session's thread; by callers while render_is_free_.
  ProgressiveRender render_;
  Clock::time_point submitted_, protected_until_;

  std::thread thread_;  // last, because it uses all other members
};

Session::Session(const SessionOptions& options) : impl_(std::make_unique<Impl>(options)) {}
Session::~Session() = default;
uint64_t Session::submit(const Document& document) { return impl_->submit(document, std::nullopt); }
uint64_t Session::submit(const Document& document, ResumePoint start) {
  return impl_->submit(document, std::move(start));
}
void Session::set_focus(const std::optional<PixelRect>& region) { impl_->set_focus(region); }
uint64_t Session::restart() { return impl_->restart(); }
void Session::pause(bool paused) { impl_->pause(paused); }
bool Session::paused() const { return impl_->paused(); }
std::shared_ptr<const Frame> Session::frame() const { return impl_->frame(); }
Status Session::status() const { return impl_->status(); }
std::shared_ptr<const scene::CompiledScene> Session::scene() const { return impl_->scene(); }
transport::Model Session::model() const { return impl_->model(); }
std::vector<double> Session::take_latencies() { return impl_->take_latencies(); }
std::vector<double> Session::take_restart_latencies() { return impl_->take_restart_latencies(); }
void Session::on_update(std::function<void()> wake) { impl_->on_update(std::move(wake)); }
void Session::finish() { impl_->finish(); }
void Session::stop() { impl_->stop(); }

film::Film Session::film_copy() {
  return impl_->between_slices([](const ProgressiveRender& render) { return render.film_copy(); });
}
ResumePoint Session::resume_point() {
  return impl_->between_slices([](const ProgressiveRender& render) { return render.resume_point(); });
}
std::vector<film::TailState> Session::tail_states() {
  return impl_->between_slices([](const ProgressiveRender& render) { return render.tail_states(); });
}
std::optional<std::vector<float>> Session::reweighted_copy() {
  return impl_->between_slices([](const ProgressiveRender& render) { return render.reweighted_copy(); });
}
std::shared_ptr<const std::vector<integrator::StoredPoint>> Session::stored_points() {
  return impl_->between_slices([](const ProgressiveRender& render) { return render.stored_points(); });
}
std::shared_ptr<const integrator::SolutionView> Session::solution_view() {
  return impl_->between_slices([](const ProgressiveRender& render) { return render.solution_view(); });
}

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
