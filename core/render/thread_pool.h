// The worker threads of a session: a TBB arena whose workers take tasks from a shared counter.
#pragma once
#include <functional>
#include <memory>

namespace etendue::render {

class ThreadPool {
 public:
  // With 0 threads: one per hardware thread.
  explicit ThreadPool(int threads);
  ~ThreadPool();

  int count() const;

  // Calls `task(i)` once for each i in [first, count), in any order and from any worker. The caller works too. Stops
  // handing out tasks when `keep_going` returns false. Returns the first number that was not handed out.
  int run(int first, int count, const std::function<void(int)>& task, const std::function<bool()>& keep_going);

  // Calls `task(begin, end)` for consecutive ranges that cover [0, count). False if `keep_going` stopped it before all
  // ranges were done.
  bool run_ranges(
      int count, const std::function<void(int, int)>& task,
      const std::function<bool()>& keep_going = [] { return true; });

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace etendue::render
