// The state of the viewer as JSON, for scripts and tests.
#pragma once
#include <string>

namespace etendue::viewer {

struct AppState;

// All parameters by name, undo depth, samples, the state of all panels, and latencies since the last report.
std::string state_report(AppState& state);

}  // namespace etendue::viewer
