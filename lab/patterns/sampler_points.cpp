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

Result<CubePoints> cube_points_of(const PointRequest& request) {
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
  CubePoints points(request.count);
  for (uint32_t i = 0; i < request.count; ++i)
    for (const uint32_t dimension : request.dimensions) {
      SampleBlock block;
      sampler->block(pixel, i, dimension / kBlockSize, block);
      points[i].push_back(static_cast<double>(block[dimension % kBlockSize]));
    }
  return points;
}

Result<PointSet> points_of(const PointRequest& request) {
  const auto points = cube_points_of(request);
  if (!points) return points.error();
  return first_two_dimensions(*points);
}

PointSet first_two_dimensions(const CubePoints& points) {
  PointSet plane;
  for (const auto& p : points) plane.push_back({p[0], p[1]});
  return plane;
}

}  // namespace etendue::patterns
