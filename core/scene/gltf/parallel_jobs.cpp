#include "scene/gltf/parallel_jobs.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "base/tsan_handoff.h"

namespace etendue::scene::gltf {
namespace {

TsanHandoff g_handoff;

// Calls `work` on this thread and on workers: on at most `most` threads in all.
void on_workers(size_t most, const std::function<void()>& work) {
  const size_t threads = std::min(most, static_cast<size_t>(tbb::this_task_arena::max_concurrency()));
  tbb::task_group group;
  for (size_t i = 1; i < threads; ++i) {
    auto task = group.defer([&work] {
      g_handoff.acquire();
      work();
    });
    g_handoff.release();
    group.run(std::move(task));
  }
  work();
  group.wait();
}

}  // namespace

void run_jobs(size_t count, const std::function<void(size_t)>& job, const std::function<bool(float)>& progress) {
  std::atomic<size_t> next{0}, done{0};
  std::atomic<bool> cancelled{false};
  std::mutex mutex;
  std::exception_ptr error;
  size_t failed = count;
  const auto caller = std::this_thread::get_id();
  on_workers(count, [&] {
    for (size_t i = next++; i < count && !cancelled; i = next++) {
      try {
        job(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (i < failed) failed = i, error = std::current_exception();
      }
      const float part = static_cast<float>(++done) / static_cast<float>(count);
      if (std::this_thread::get_id() == caller && !progress(part)) cancelled = true;
    }
  });
  if (cancelled) throw Cancelled{};
  if (error) std::rethrow_exception(error);
}

}  // namespace etendue::scene::gltf
