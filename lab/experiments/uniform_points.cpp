#include "experiments/uniform_points.h"

namespace etendue::experiments {
namespace {

Result<void> check_sampler_name(std::string_view name) {
  if (find_sampler(name)) return {};
  std::string names;
  for (const SamplerInfo& info : sampler_infos()) names += (names.empty() ? "" : ", ") + info.name;
  return usage_error("there is no sampler '" + std::string(name) + "'; give one of " + names);
}

std::vector<Option> sampler_options() {
  std::vector<Option> options;
  for (const SamplerInfo& info : sampler_infos()) options.push_back({info.name.c_str(), info.label.c_str()});
  return options;
}

}  // namespace

Text sampler_parameter(const char* doc) {
  return {"sampler", "Sampler", sampler_infos().front().name, doc, check_sampler_name, sampler_options()};
}

UniformPoints::UniformPoints(const std::string& sampler, uint32_t points, const std::vector<Setting>& settings)
    : sampler_(make_sampler(sampler, settings)) {
  sampler_->prepare(0, points);
}

void UniformPoints::point(uint32_t seed, uint32_t index, std::span<double> out) const {
  SampleBlock block;
  for (size_t d = 0; d < out.size(); ++d) {
    if (d % kBlockSize == 0) sampler_->block(seed, index, static_cast<uint32_t>(d / kBlockSize), block);
    out[d] = static_cast<double>(block[d % kBlockSize]);
  }
}

}  // namespace etendue::experiments
