// Finite point sets of the unit square.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace etendue::patterns {

using PlanePoint = std::array<double, 2>;  // in [0, 1)^2
using PointSet = std::vector<PlanePoint>;

// The points f(0), ..., f(count - 1).
template <class F>
PointSet point_set(uint32_t count, F&& f) {
  PointSet set;
  for (uint32_t i = 0; i < count; ++i) set.push_back(f(i));
  return set;
}

}  // namespace etendue::patterns
