// Points of the samplers of the renderer, as used by experiments.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "sampling/sampler.h"

namespace etendue::experiments {

// Parameter "sampler": the name of a sampler of the registry.
Text sampler_parameter(const char* doc);

// The points of a sampler in any number of dimensions. Dimensions beyond eight are those of further blocks.
class UniformPoints {
 public:
  // `points` is the largest number of points. The settings are those of the sampler's parameters.
  UniformPoints(const std::string& sampler, uint32_t points, const std::vector<Setting>& settings = {});
  // Point `index` of the sequence with this seed, single-precision numbers in [0, 1).
  void point(uint32_t seed, uint32_t index, std::span<double> out) const;

 private:
  std::unique_ptr<Sampler> sampler_;
};

}  // namespace etendue::experiments
