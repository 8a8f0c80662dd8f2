#include "render/limit_progress.h"

#include <algorithm>

#include "base/vec.h"

namespace etendue::render {
namespace {

Prediction certain(double seconds) {
  seconds = std::max(0.0, seconds);
  return {seconds, {seconds, seconds}};
}

}  // namespace

bool sample_or_time_limit_reached(const Limits& limits, uint32_t samples, double seconds) {
  if (limits.samples > 0 && samples >= limits.samples) return true;
  if (limits.seconds <= 0 || samples == 0) return false;
  const double seconds_per_sample = seconds / samples;
  return seconds + 0.5 * seconds_per_sample >= limits.seconds;
}

double progress_to_limit(const Limits& limits, const SamplingState& state) {
  double progress = 0;
  if (limits.samples > 0) progress = std::max(progress, static_cast<double>(state.samples) / limits.samples);
  if (limits.seconds > 0) progress = std::max(progress, state.seconds / limits.seconds);
  // The error falls about as the square root of the number of samples.
  if (limits.error > 0 && state.error.known)
    progress = std::max(progress, sqr(limits.error / std::max(state.error.value, 1e-30)));
  return std::min(progress, 1.0);
}

std::optional<Prediction> time_to_limit(const Limits& limits, const SamplingState& state) {
  std::optional<Prediction> nearest;
  const auto consider = [&](const std::optional<Prediction>& p) {
    if (p && (!nearest || p->seconds < nearest->seconds)) nearest = p;
  };
  if (limits.samples > 0 && state.samples > 0)
    consider(certain(state.seconds / state.samples * (static_cast<double>(limits.samples) - state.samples)));
  if (limits.seconds > 0) consider(certain(limits.seconds - state.seconds));
  if (limits.error > 0) consider(state.estimator.time_to(limits.error, state.seconds));
  return nearest;
}

}  // namespace etendue::render
