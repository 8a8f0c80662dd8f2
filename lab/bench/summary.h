// Statistics of a benchmark: slopes, efficiency, bias and errors per method.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bench/benchmark.h"

namespace etendue::bench {

// The statistics of one method at the end of its repeats. The error of the reference has been subtracted.
struct MethodSummary {
  std::string name;
  metrics::Estimate slope, slope_over_samples;         // of log RMSE over log time and log samples
  metrics::Estimate efficiency;                        // 1 / (MSE * seconds)
  metrics::Estimate bias;                              // radiance
  std::optional<metrics::BiasVariance> bias_variance;  // with at least two repeats
  double rmse = 0, relmse = 0;                         // medians over the repeats
  double spp = 0, seconds = 0, rays_per_second = 0;    // medians over the repeats
  std::optional<double> startup_seconds;               // of another renderer, median
  double displayed = 0;                                // root mean square error of displayed values, median
  double flip = 0;                                     // mean FLIP of the last repeat with the document's display
  std::optional<double> khat;        // Pareto tail index of the samples (film/tail.h); nothing if there is no tail
  bool has_heavy_tail = false;       // the error estimate is unreliable (render/reliability.h)
  bool reference_too_noisy = false;  // metrics::is_reference_too_noisy
};

MethodSummary summary_of(const MethodResult& result, const Reference& reference, const render::Display& display);

// The curves after subtraction of the reference's noise, as drawn in charts.
std::vector<metrics::MethodCurves> corrected_curves(const Outcome& outcome, const Reference& reference);

// True if the error of the reference is known and makes a measured error uncertain (metrics::is_reference_too_noisy).
bool reference_too_noisy(const Outcome& outcome, const Reference& reference);

// The rendering time of the reference that would suffice for all methods, in seconds; 0 if the present one suffices or
// the time is unknown.
double required_reference_seconds(const Outcome& outcome, const Reference& reference);

}  // namespace etendue::bench
