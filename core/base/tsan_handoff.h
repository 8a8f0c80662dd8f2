// Tells ThreadSanitizer that a task starts after the code that submitted it.
//
// TBB synchronises the two threads, but ThreadSanitizer does not see this, because the library is not instrumented. The
// submitting thread calls `release`, the task calls `acquire` before it reads anything, even a captured reference. A
// TsanHandoff is therefore a static variable. The end of a task needs none: ~task_group is compiled with the program
// and loads what the last task stored.
#pragma once
#include <atomic>
#include <cstdint>

namespace etendue {

class TsanHandoff {
 public:
  void release() { releases_.fetch_add(1, std::memory_order_release); }
  void acquire() const { static_cast<void>(releases_.load(std::memory_order_acquire)); }

 private:
  std::atomic<uint64_t> releases_{0};
};

}  // namespace etendue
