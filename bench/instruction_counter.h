// Counts the instructions that this process retires in user mode, in all threads that start after the counter
// (perf_event_open(2)).
//
// Unlike times, instruction counts do not depend on the load of the machine. Works on Linux where the kernel allows a
// process to count its own instructions; elsewhere the count is unknown.
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
