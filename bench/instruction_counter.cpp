#include "instruction_counter.h"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace etendue {

Instructions::Instructions() {
  perf_event_attr event{};
  event.type = PERF_TYPE_HARDWARE;
  event.size = sizeof event;
  event.config = PERF_COUNT_HW_INSTRUCTIONS;
  event.exclude_kernel = 1;
  event.exclude_hv = 1;
  event.inherit = 1;
  file_ = static_cast<int>(::syscall(SYS_perf_event_open, &event, 0, -1, -1, 0));
}

Instructions::~Instructions() {
  if (file_ >= 0) ::close(file_);
}

std::optional<uint64_t> Instructions::count() const {
  uint64_t value = 0;
  if (file_ < 0 || ::read(file_, &value, sizeof value) != sizeof value) return {};
  return value;
}

}  // namespace etendue
