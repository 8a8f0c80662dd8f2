// Counts the instructions that this process retires in user mode, in all threads that start after the counter.
//
// Unlike seconds they do not depend on what else the machine does. Linux, where it allows processes to count their own;
// elsewhere the count is unknown.                                                           perf_event_open(2)
#pragma once
#include <cstdint>
#include <optional>

namespace etendue {

class Instructions {
 public:
  Instructions();
  ~Instructions();
  Instructions(const Instructions&) = delete;
  Instructions& operator=(const Instructions&) = delete;

  std::optional<uint64_t> count() const;

 private:
  int file_;
};

}  // namespace etendue
