// How to make a bench again.
#pragma once
#include <string>

#include "bench/report.h"

namespace etendue::bench {

// The command line of `etendue bench` that measures the same: what the scene, the document and the plan say, quoted for
// a shell. Curves over samples come out the same, unless a longer reference is kept; those over seconds are of the
// machine.
std::string recipe(const Report& report);

}  // namespace etendue::bench
