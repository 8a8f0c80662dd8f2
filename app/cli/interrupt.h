// Ctrl-C.
#pragma once
#include <atomic>

namespace etendue::cli {

// From now on the first SIGINT or SIGTERM only sets this flag: to stop and save. A second one is left to the system.
const std::atomic<bool>& watch_interrupts();

}  // namespace etendue::cli
