// How far a rendering is from its limits, and when it reaches the nearest one.
#pragma once
#include <optional>

#include "render/document.h"
#include "render/time_estimate.h"

namespace etendue::render {

// The state of a rendering after its last complete sample.
struct SamplingState {
  uint32_t samples = 0;  // per pixel
  double seconds = 0;    // of rendering
  const film::MeasuredError& error;  // in the measure of the limits
  const TimeEstimator& estimator;
};

// Whether the limit on samples or on time is reached. One more sample of all pixels is not begun if it is expected to
// end later than half of its duration after the time limit.
bool sample_or_time_limit_reached(const Limits& limits, uint32_t samples, double seconds);

// Progress towards the nearest limit, 0 to 1; 0 without limits.
double progress_to_limit(const Limits& limits, const SamplingState& state);

// The remaining time until the nearest limit. Nothing without limits, or while it cannot be predicted.
std::optional<Prediction> time_to_limit(const Limits& limits, const SamplingState& state);

}  // namespace etendue::render
