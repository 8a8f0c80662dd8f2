// The time since this process was started.
#pragma once

namespace etendue::viewer {

// Seconds since the start of the process, with a resolution of 0.01 s; 0 if /proc is not available.
double process_age();

}  // namespace etendue::viewer
