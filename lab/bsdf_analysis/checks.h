// The checks of a test surface: verdicts with the measured value that supports them. Declarations of models are not
// used.
#pragma once
#include <string>
#include <vector>

#include "bsdf_analysis/plausibility.h"
#include "bsdf_analysis/sampling_quality.h"

namespace etendue::bsdf_analysis {

struct Check {
  const char* name;                         // "non-negative", "reciprocal", "conserves-energy", "well-sampled"
  const char *passed_label, *failed_label;  // the verdict as shown to users
  bool holds = false;
  std::string reason;  // the decisive value and the angles at which it was measured

  const char* label() const { return holds ? passed_label : failed_label; }
};

struct SurfaceAnalysis {
  std::vector<Albedo> albedo;         // light from above the surface
  std::vector<Albedo> albedo_inside;  // light from below; empty for opaque surfaces
  Plausibility plausibility;
  std::vector<SamplingQuality> sampling;
  std::vector<Check> checks;
};

// Runs all measurements; they take a few hundredths of a second for most models. The result is incomplete if
// `keep_going` returned false.
SurfaceAnalysis analyze(const Lobes& lobes, const KeepGoing& keep_going = {});

}  // namespace etendue::bsdf_analysis
