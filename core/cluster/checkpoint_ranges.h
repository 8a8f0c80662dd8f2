// The numbers of the samples that a checkpoint contains, as a member of its state (render::state_json).
#pragma once
#include <string>

#include "cluster/sample_ranges.h"

namespace etendue::cluster {

// The state with the ranges.
std::string with_ranges(const std::string& state, const SampleRanges& ranges);
// The ranges of a state; the samples from 0 to `samples` - 1 if it names none, as after a rendering by one process.
SampleRanges ranges_of(const std::string& state, uint32_t samples);

}  // namespace etendue::cluster
