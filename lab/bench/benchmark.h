// Methods against each other: their errors over time, interleaved so that what the machine does meets all alike.
#pragma once
#include <optional>
#include <vector>

#include "bench/method_spec.h"
#include "bench/progress.h"
#include "bench/reference.h"
#include "metrics/convergence.h"

namespace etendue::bench {

struct Plan {
  std::vector<MethodSpec> methods;
  double seconds = 0;    // of rendering, for each method in each repeat; 0 is no limit
  uint32_t samples = 0;  // the same; one of both is given
  int repeats = 1;
  uint64_t seed = 0;  // every repeat of every method has a seed of its own that is made of this one
};

struct MethodResult {
  metrics::MethodCurves curves;  // as measured: with the reference's noise in them
  std::vector<double> rays_per_second;
  std::vector<float> picture;  // of the last repeat, linear
  // For telling bias from variance: the mean picture of the repeats, and the mean of their errors.
  std::vector<double> mean_picture;
  double mean_mse = 0;
  std::shared_ptr<const render::Reliability> health;  // of the last repeat; none while there are too few samples
};

struct Outcome {
  std::vector<MethodResult> methods;
  bool interrupted = false;
};

// Errors are measured at 1, 2, 3, 4, 6, 8, 12 ... samples and at the end; only rendering is on the clock. The watch may
// cut it short: the outcome then holds the repeats that are whole.
Outcome run(render::Session& session, const Plan& plan, const Reference& reference, const Progress& watch);

}  // namespace etendue::bench
