// Work that the interface does not wait for. A result that nobody wants any more is dropped when it comes.
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace etendue::viewer {

template <class T>
class Job {
 public:
  // `wake` is called from the job's thread when the result is there.
  explicit Job(std::function<void()> wake) : wake_(std::move(wake)) {}
  ~Job() {
    for (auto& worker : workers_) worker.thread.join();
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  bool running() const { return state_ != nullptr; }

  void start(std::function<T()> work) {
    reap();
    state_ = std::make_shared<State>();
    workers_.push_back({state_, std::thread([state = state_, work = std::move(work), wake = wake_] {
                          T result = work();
                          {
                            const std::lock_guard lock(state->mutex);
                            state->result = std::move(result);
                            state->done = true;
                          }
                          wake();
                        })});
  }

  void abandon() { state_.reset(); }

  // The result, once.
  std::optional<T> take() {
    if (!state_) return std::nullopt;
    const auto state = state_;
    const std::lock_guard lock(state->mutex);
    if (state->done) state_.reset();
    return std::exchange(state->result, std::nullopt);
  }

 private:
  struct State {
    std::mutex mutex;
    bool done = false;
    std::optional<T> result;
  };
  struct Worker {
    std::shared_ptr<State> state;
    std::thread thread;
  };

  void reap() {
    std::erase_if(workers_, [](Worker& worker) {
      {
        const std::lock_guard lock(worker.state->mutex);
        if (!worker.state->done) return false;
      }
      worker.thread.join();
      return true;
    });
  }

  std::function<void()> wake_;
  std::shared_ptr<State> state_;
  std::vector<Worker> workers_;
};

}  // namespace etendue::viewer
