// Background work that publishes better and better results and that can be cancelled.
#pragma once
#include <atomic>

#include "bench/progress.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

template <class T>
class ProgressiveTask {
 public:
  using Publisher = std::function<void(const T&)>;
  // Calls `publish` with each result, and returns soon after `progress` has returned false.
  using Work = std::function<void(const Publisher& publish, const bench::Progress& progress)>;

  ProgressiveTask() = default;
  ~ProgressiveTask() { cancel(); }
  ProgressiveTask(const ProgressiveTask&) = delete;
  ProgressiveTask& operator=(const ProgressiveTask&) = delete;

  // Cancels the previous work. `wake` is called on the thread of the work when there is a new result.
  void start(Work work, const std::function<void()>& wake) {
    cancel();
    taken_.reset();
    state_ = std::make_shared<State>();
    const auto run = [state = state_, wake, work = std::move(work)] {
      const Publisher publish = [&](const T& value) {
        {
          const std::lock_guard lock(state->mutex);
          state->latest = std::make_shared<const T>(value);
        }
        wake();
      };
      const bench::Progress progress = [&](double share, const std::string&) {
        state->progress = share;
        return !state->cancelled;
      };
      work(publish, progress);
      state->finished = true;
      return true;
    };
    task_.start(run, wake);
  }

  // Results that are published after this are discarded; `result` stays.
  void cancel() {
    if (state_) state_->cancelled = true;
    state_.reset();
    task_.abandon();
  }

  // Cancels the work and discards the result.
  void reset() {
    cancel();
    result_.reset();
  }

  bool running() const { return state_ != nullptr; }
  // Share of the work that is done, 0 to 1.
  double progress() const { return state_ ? state_->progress.load() : 1; }
  // The result that the last call of `update` took, also of work that was cancelled later. Null if there is none.
  const std::shared_ptr<const T>& result() const { return result_; }
  // Whether `update` would change something.
  bool has_update() const { return state_ && (state_->finished || state_->load() != taken_); }

  // Takes the newest result. Returns true when the work has finished.
  bool update() {
    if (!state_) return false;
    const bool finished = state_->finished;
    if (auto latest = state_->load()) {
      taken_ = latest;
      result_ = std::move(latest);
    }
    if (finished) cancel();
    return finished;
  }

 private:
  struct State {
    std::shared_ptr<const T> load() {
      const std::lock_guard lock(mutex);
      return latest;
    }
    std::mutex mutex;
    std::shared_ptr<const T> latest;
    std::atomic<bool> cancelled{false};
    std::atomic<bool> finished{false};
    std::atomic<double> progress{0};
  };

  std::shared_ptr<State> state_;
  std::shared_ptr<const T> taken_;  // the last value taken from state_
  std::shared_ptr<const T> result_;
  BackgroundTask<bool> task_;
};

}  // namespace etendue::viewer
