// Interruption by Ctrl-C.
#pragma once
#include <atomic>

namespace etendue::cli {

// From this call on, the first SIGINT or SIGTERM only sets the returned flag, so that results can be saved. A second
// signal ends the process.
const std::atomic<bool>& watch_interrupts();

}  // namespace etendue::cli
