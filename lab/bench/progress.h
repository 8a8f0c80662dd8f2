// Progress reports and interruption of long measurements.
#pragma once
#include <functional>
#include <string>

#include "render/session.h"

namespace etendue::bench {

// Receives the fraction of the work that is done, 0 to 1, and a description of the current step. Returning false
// interrupts the work.
using Progress = std::function<bool(double done, const std::string& what)>;

// Waits until the session has rendered this version to its limit and returns true. Polls `keep_going` while the version
// is rendered; if it returns false, stops the session and returns false.
bool wait_for(render::Session& session, uint64_t version, const std::function<bool(const render::Status&)>& keep_going);

}  // namespace etendue::bench
