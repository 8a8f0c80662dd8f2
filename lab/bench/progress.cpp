#include "bench/progress.h"

#include <chrono>
#include <thread>

namespace etendue::bench {

bool wait_for(render::Session& session, uint64_t version,
              const std::function<bool(const render::Status&)>& keep_going) {
  while (true) {
    const auto status = session.status();
    // Until the session has started this version, status and film belong to the previous one.
    const bool has_started = status.version == version;
    if (has_started && status.finished) return true;
    if (has_started && !keep_going(status)) {
      session.stop();
      return false;
    }
    // Polling does not affect measurements: the time of a rendering is the sum over its passes.
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace etendue::bench
