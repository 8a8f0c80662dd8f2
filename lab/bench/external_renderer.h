// Renderers outside of this program, as methods of a benchmark.
//
// A renderer is a command with the placeholders {spp}, {seed} and {out}, and optionally {width} and {height}. It renders
// the scene of the benchmark with that many samples per pixel and that seed, and writes an image with linear pixel
// values to the file {out}, an OpenEXR file. Each run starts again, so the time of a run contains the start-up: reading the scene and
// building acceleration structures.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace etendue::bench {

struct ExternalRun {
  uint32_t samples = 0;  // per pixel
  double seconds = 0;    // wall time of the program
};

// The time of runs as start-up plus rendering time in proportion to the samples.
struct ExternalTime {
  double startup = 0;     // seconds
  double per_sample = 0;  // seconds
};

// From the first and the last of runs with increasing numbers of samples. A single run, or runs whose time does not
// increase, give no start-up.
ExternalTime time_of(std::span<const ExternalRun> runs);

// The number of samples of the next run, starting with 1: twice that of the last, reduced to the rest of the budget if that would exceed it;
// 0 if the budget is used up. `seconds` limits the rendering time without start-up and `samples` the samples; 0 is no
// limit.
uint32_t next_external_samples(std::span<const ExternalRun> runs, double seconds, uint32_t samples);

// A usage error names the missing placeholder.
Result<void> check_external_command(const std::string& command);

struct ExternalImage {
  std::vector<float> rgb;  // linear
  double seconds = 0;      // wall time
};

// Runs the command once. Errors: the program fails, or its image is missing or of another size.
Result<ExternalImage> render_externally(const std::string& command, int width, int height, uint32_t samples,
                                        uint64_t seed, const std::function<bool()>& keep_going);

}  // namespace etendue::bench
