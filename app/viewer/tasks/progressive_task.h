// Work in the background whose result gets better step by step, and that can be called off. What it tells after that is
// dropped.
#pragma once
#include <atomic>

#include "bench/progress.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

template <class T>
class Study {
 public:
  using Publisher = std::function<void(const T&)>;
  // Publishes what it has so far, and ends soon once the watch says so.
  using RenderState = std::function<void(const Publisher& publish, const bench::Progress& watch)>;

  // `wake` is called from the work's thread when there is something new.
  explicit Study(const std::function<void()>& wake) : wake_(wake), job_(wake) {}
  ~Study() { call_off(); }
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  void start(RenderState work) {
    call_off();
    state_ = std::make_shared<State>();
    job_.start([state = state_, wake = wake_, work = std::move(work)] {
      const Publisher publish = [&](const T& value) {
        {
          const std::lock_guard lock(state->mutex);
          state->latest = std::make_shared<const T>(value);
        }
        wake();
      };
      work(publish, [&](double done, const std::string&) { return state->progress = done, state->wanted.load(); });
      return state->ended = true;
    });
  }

  void call_off() {
    if (state_) state_->wanted = false;
    state_.reset();
    job_.abandon();
  }

  // Forgets what was told as well.
  void clear() { call_off(), shown_.reset(); }

  bool running() const { return state_ != nullptr; }
  double progress() const { return state_ ? state_->progress.load() : 1; }
  // What `advance` took up last, also of work that was called off.
  const std::shared_ptr<const T>& shown() const { return shown_; }
  bool has_news() const { return state_ && (state_->ended || state_->now() != state_->taken); }

  // Called once a frame; true when the work has come to its end.
  bool advance() {
    if (!state_) return false;
    const bool ended = state_->ended;
    if (auto latest = state_->now()) shown_ = state_->taken = std::move(latest);
    if (ended) call_off();
    return ended;
  }

 private:
  struct State {
    std::shared_ptr<const T> now() {
      const std::lock_guard lock(mutex);
      return latest;
    }
    std::mutex mutex;
    std::shared_ptr<const T> latest;
    std::shared_ptr<const T> taken;  // of the interface's thread
    std::atomic<bool> wanted{true}, ended{false};
    std::atomic<double> progress{0};
  };

  const std::function<void()> wake_;
  std::shared_ptr<State> state_;
  std::shared_ptr<const T> shown_;
  Job<bool> job_;
};

}  // namespace etendue::viewer
