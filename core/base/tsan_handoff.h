// What a thread did before it gave work to a task library, said in the language's own terms.
//
// TBB orders the giver before the taker by means that a thread sanitizer does not see, as the library is not compiled
// with one. `take` has to come before anything of the task is read, even a captured reference: a handover is therefore
// a static variable. Ends need none, because ~task_group loads, in code that is compiled here, what the last task
// stored.
#pragma once
#include <atomic>
#include <cstdint>

namespace etendue {

class TsanHandoff {
 public:
  void release() { given_.fetch_add(1, std::memory_order_release); }
  void acquire() const { static_cast<void>(given_.load(std::memory_order_acquire)); }

 private:
  std::atomic<uint64_t> given_{0};
};

}  // namespace etendue
