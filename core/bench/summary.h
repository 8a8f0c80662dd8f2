// What is read off the curves of a bench.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bench/run.h"

namespace etendue::bench {

// Of one method, at the end of its repeats; errors are without the reference's own.
struct MethodSummary {
  std::string name;
  measure::Figure slope, slope_over_samples;  // of RMSE
  measure::Figure efficiency;                 // 1 / (MSE * seconds)
  measure::Figure bias;                       // radiance
  std::optional<measure::Split> split;        // with two repeats or more
  double rmse = 0, relmse = 0;                // medians
  double spp = 0, seconds = 0, rays_per_second = 0;
  std::optional<double> khat;  // of the last repeat (measure/tail.h); nothing where there is no tail to fit
  double flip = 0;  // of the last repeat, as the document is shown
  // The reference is not ten times better than the best picture: too noisy to tell small errors.
  bool too_noisy = false;
};

MethodSummary summary_of(const MethodResult& result, const Reference& reference, const render::Display& display);

// The curves without the reference's noise, as they are drawn.
std::vector<measure::MethodCurves> corrected_curves(const Outcome& outcome, const Reference& reference);

// Seconds of reference that would make it good enough for all methods; 0 if it is, or if its error is unknown.
double seconds_wanted(const Outcome& outcome, const Reference& reference);

}  // namespace etendue::bench
