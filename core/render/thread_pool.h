// The threads of a session: a TBB arena whose workers draw tiles from a counter and look at a flag between rows.
#pragma once
#include <atomic>
#include <functional>
#include <memory>

namespace etendue::render {

class ThreadPool {
 public:
  // 0 threads: one per hardware thread.
  explicit ThreadPool(int threads);
  ~ThreadPool();

  int count() const;
  // Calls `task(i)` for i = first .. count-1, each once, in any order and from any worker, until all are done or
  // `keep_going` returns false between two tasks. Returns the first number that was not handed out. The caller works
  // too.
  int run(int first, int count, const std::function<void(int)>& task, const std::function<bool()>& keep_going);
  // Calls `task(begin, end)` for pieces of the rows 0 .. rows-1; false if `keep_going` cut it short.
  bool for_bands(
      int rows, const std::function<void(int, int)>& task,
      const std::function<bool()>& keep_going = [] { return true; });

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace etendue::render
