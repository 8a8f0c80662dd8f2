#include "render/thread_pool.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

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
  tbb::global_control control;  // allows more threads than the machine has, where a user asks for them
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
      auto task_of_worker = group.defer([&work] {
        g_handoff.acquire();
        work();
      });
      g_handoff.release();
      group.run(std::move(task_of_worker));
    }
    work();
    group.wait();
  });
  return std::min(next.load(), count);
}

bool ThreadPool::for_bands(int rows, const std::function<void(int, int)>& task,
                           const std::function<bool()>& keep_going) {
  constexpr int kBand = 16;
  const int bands = (rows + kBand - 1) / kBand;
  std::atomic<int> done{0};
  const auto band = [&](int i) {
    task(i * kBand, std::min((i + 1) * kBand, rows));
    done.fetch_add(1, std::memory_order_relaxed);
  };
  run(0, bands, band, keep_going);
  return done.load() == bands;
}

}  // namespace etendue::render
