// What is read off the curves of a bench.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bench/benchmark.h"

namespace etendue::bench {

// Of one method, at the end of its repeats; errors are without the reference's own.
struct MethodSummary {
  std::string name;
  metrics::Figure slope, slope_over_samples;  // of RMSE
  metrics::Figure efficiency;                 // 1 / (MSE * seconds)
  metrics::Figure bias;                       // radiance
  std::optional<metrics::Split> split;        // with two repeats or more
  double rmse = 0, relmse = 0;                // medians
  double spp = 0, seconds = 0, rays_per_second = 0;
  double flip = 0;             // of the last repeat, as the document is shown
  std::optional<double> khat;  // of the samples' tail (measure/tail.h); nothing where there is none to fit
  bool heavy_tail = false;     // so heavy that errors cannot be told from few repeats (render/health.h)
  // The reference is not ten times better than the best picture: too noisy to tell small errors.
  bool too_noisy = false;
};

MethodSummary summary_of(const MethodResult& result, const Reference& reference, const render::Display& display);

// The curves without the reference's noise, as they are drawn.
std::vector<metrics::MethodCurves> corrected_curves(const Outcome& outcome, const Reference& reference);

// Whether the error of the reference is known not to be ten times smaller than the smallest error that was measured.
bool reference_too_noisy(const Outcome& outcome, const Reference& reference);

// Seconds of reference that would make it good enough for all methods; 0 if it is, or if that is unknown.
double seconds_wanted(const Outcome& outcome, const Reference& reference);

}  // namespace etendue::bench
