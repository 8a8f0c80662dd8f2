// The points that a sampler gives to one pixel.
#pragma once
#include <string>

#include "base/result.h"
#include "patterns/cube_discrepancy.h"
#include "patterns/point_set.h"
#include "sampling/sampler.h"

namespace etendue::patterns {

struct PointRequest {
  std::string sampler;
  std::vector<Setting> settings = {};  // of the sampler; must have passed parse_value
  uint32_t count = 64;
  std::vector<uint32_t> dimensions = {0, 1};  // of a path, in blocks of kBlockSize; at least two
  uint64_t seed = 0;                          // of the pixel
};

// All requested dimensions, and the first two of them. An input error names what is wrong: an unknown sampler, no points
// or too many, a dimension that no path has.
Result<CubePoints> cube_points_of(const PointRequest& request);
Result<PointSet> points_of(const PointRequest& request);
PointSet first_two_dimensions(const CubePoints& points);

inline constexpr uint32_t kMostPoints = 1U << 20;
inline constexpr uint32_t kMostDimensions = 1U << 16;

}  // namespace etendue::patterns
