#include "render/thread_pool.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <thread>

#include "base/tsan_handoff.h"
#include "geometry/accel.h"

namespace etendue::render {
namespace {

TsanHandoff g_handoff;

}  // namespace

struct ThreadPool::Arena {
  explicit Arena(int n)
      : threads(n), control(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(n)), arena(n, 1) {}
  int threads;
  tbb::global_control control;  // permits more threads than the machine has
  tbb::task_arena arena;
};

ThreadPool::ThreadPool(int threads)
    : arena_(std::make_unique<Arena>(
          threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency())))) {}

ThreadPool::~ThreadPool() = default;

int ThreadPool::count() const { return arena_->threads; }

int ThreadPool::run(int first, int count, const std::function<void(int)>& task,
                    const std::function<bool()>& keep_going) {
  std::atomic<int> next{first};
  const auto work = [&] {
    prepare_thread_for_rays();
    while (keep_going()) {
      const int i = next.fetch_add(1, std::memory_order_relaxed);
      if (i >= count) return;
      task(i);
    }
  };
  arena_->arena.execute([&] {
    tbb::task_group group;
    for (int i = 1; i < arena_->threads; ++i) {
      auto worker_task = group.defer([&work] {
        g_handoff.acquire();
        work();
      });
      g_handoff.release();
      group.run(std::move(worker_task));
    }
    work();
    group.wait();
  });
  return std::min(next.load(), count);
}

bool ThreadPool::run_ranges(int count, const std::function<void(int, int)>& task,
                            const std::function<bool()>& keep_going) {
  constexpr int kRangeSize = 16;
  const int ranges = (count + kRangeSize - 1) / kRangeSize;
  std::atomic<int> done{0};
  const auto run_range = [&](int i) {
    task(i * kRangeSize, std::min((i + 1) * kRangeSize, count));
    done.fetch_add(1, std::memory_order_relaxed);
  };
  run(0, ranges, run_range, keep_going);
  return done.load() == ranges;
}

}  // namespace etendue::render
