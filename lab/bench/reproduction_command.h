// The command that repeats a benchmark.
#pragma once
#include <string>

#include "bench/report.h"

namespace etendue::bench {

// The command line of `etendue bench` with the scene, the settings and the plan of the report, quoted for a shell. It
// reproduces curves over samples exactly, unless a longer reference is cached. Curves over seconds depend on the
// machine.
std::string reproduction_command(const Report& report);

}  // namespace etendue::bench
