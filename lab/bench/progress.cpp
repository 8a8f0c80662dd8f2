#include "bench/progress.h"

#include <chrono>
#include <thread>

namespace etendue::bench {

bool wait_for(render::Session& session, uint64_t version,
              const std::function<bool(const render::Status&)>& keep_going) {
  while (true) {
    const auto status = session.status();
    // Before it is taken up, the session still has the film of what came before: nothing to stop and look at.
    const bool taken_up = status.version == version;
    if (taken_up && status.finished) return true;
    if (taken_up && !keep_going(status)) return session.stop(), false;
    // Nothing here is on the clock: a rendering's seconds are those of its passes.
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace etendue::bench
