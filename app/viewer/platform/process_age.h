// How long this process has been there.
#pragma once

namespace etendue::viewer {

// Seconds since the process was started, to a hundredth; 0 where the system does not tell.
double process_age();

}  // namespace etendue::viewer
