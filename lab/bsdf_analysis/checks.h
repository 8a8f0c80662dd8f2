// The verdicts on a surface, each with what it rests on. They are measured: nothing here asks a model what it claims.
#pragma once
#include <string>
#include <vector>

#include "bsdf_analysis/plausibility.h"
#include "bsdf_analysis/sampling_quality.h"

namespace etendue::bsdf_analysis {

struct Check {
  const char* name;      // "non-negative", "reciprocal", "conserves-energy", "well-sampled"
  const char *yes, *no;  // the verdict in words
  bool holds = false;
  std::string reason;  // the figure, and where

  const char* label() const { return holds ? yes : no; }
};

struct Audit {
  std::vector<Albedo> albedo;         // of light from outside
  std::vector<Albedo> albedo_inside;  // of light from below; empty where none passes
  Plausibility plausibility;
  std::vector<SamplingQuality> sampling;
  std::vector<Check> badges;
};

// All of it; a few hundredths of a second for most. Incomplete if `wanted` said no.
Audit audit(const Lobes& lobes, const Wanted& wanted = {});

}  // namespace etendue::bsdf_analysis
