#include "patterns/sampler_points.h"

#include "base/hash.h"

namespace etendue::patterns {
namespace {

std::string sampler_names() {
  std::string names;
  for (const SamplerInfo& info : sampler_infos()) names += (names.empty() ? "" : ", ") + info.name;
  return names;
}

}  // namespace

Result<PointSet> points_of(const PointRequest& request) {
  const auto sampler = make_sampler(request.sampler, request.settings);
  if (!sampler) return usage_error("there is no sampler '" + request.sampler + "'; give one of " + sampler_names());
  if (request.count < 1 || request.count > kMostPoints)
    return usage_error("the number of points is " + std::to_string(request.count) + "; give one from 1 to " +
                       std::to_string(kMostPoints));
  for (const uint32_t dimension : request.dimensions)
    if (dimension >= kMostDimensions)
      return usage_error("there is no dimension " + std::to_string(dimension) + "; give one from 0 to " +
                         std::to_string(kMostDimensions - 1));
  sampler->prepare(0, request.count);
  const auto pixel = static_cast<uint32_t>(mix_bits(request.seed + 1));
  PointSet points(request.count);
  for (uint32_t i = 0; i < request.count; ++i)
    for (size_t axis = 0; axis < 2; ++axis) {
      SampleBlock block;
      sampler->block(pixel, i, request.dimensions[axis] / kBlockSize, block);
      points[i][axis] = static_cast<double>(block[request.dimensions[axis] % kBlockSize]);
    }
  return points;
}

}  // namespace etendue::patterns
