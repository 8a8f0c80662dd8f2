// How to make a bench again.
#pragma once
#include <string>

#include "bench/report.h"

namespace etendue::bench {

// The command line of `etendue bench` that measures the same: what the scene, the document and the plan say, quoted for
// a shell. Curves over samples come out the same, those over seconds as the machine is.
std::string recipe(const Report& report);

}  // namespace etendue::bench
