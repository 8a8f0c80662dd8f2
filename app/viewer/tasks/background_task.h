// A function that runs on a thread of its own and returns one result.
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace etendue::viewer {

// All member functions are called on one thread, that of the interface.
template <class T>
class BackgroundTask {
 public:
  BackgroundTask() = default;
  // Waits for the threads, also for those of abandoned work.
  ~BackgroundTask() {
    for (auto& worker : workers_) worker.thread.join();
  }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  // Starts the work on a new thread and abandons the previous work. `wake` is called on that thread when the result is
  // available.
  void start(std::function<T()> work, std::function<void()> wake) {
    join_finished();
    state_ = std::make_shared<State>();
    workers_.push_back({state_, std::thread([state = state_, work = std::move(work), wake = std::move(wake)] {
                          T result = work();
                          {
                            const std::lock_guard lock(state->mutex);
                            state->result = std::move(result);
                            state->done = true;
                          }
                          wake();
                        })});
  }

  // The work continues on its thread, but its result is discarded.
  void abandon() { state_.reset(); }

  // Whether there is work whose result was not taken.
  bool running() const { return state_ != nullptr; }
  bool has_result() const {
    if (!state_) return false;
    const std::lock_guard lock(state_->mutex);
    return state_->done;
  }
  // The result, once.
  std::optional<T> take_result() {
    if (!state_) return std::nullopt;
    const auto state = state_;
    const std::lock_guard lock(state->mutex);
    if (state->done) state_.reset();
    return std::exchange(state->result, std::nullopt);
  }

 private:
  struct State {
    mutable std::mutex mutex;
    bool done = false;
    std::optional<T> result;
  };
  struct Worker {
    std::shared_ptr<State> state;
    std::thread thread;
  };

  void join_finished() {
    std::erase_if(workers_, [](Worker& worker) {
      {
        const std::lock_guard lock(worker.state->mutex);
        if (!worker.state->done) return false;
      }
      worker.thread.join();
      return true;
    });
  }

  std::shared_ptr<State> state_;
  std::vector<Worker> workers_;
};

}  // namespace etendue::viewer
