// Finite point sets of the unit square.
#pragma once
#include <array>
#include <vector>

namespace etendue::patterns {

using PlanePoint = std::array<double, 2>;  // in [0, 1)^2
using PointSet = std::vector<PlanePoint>;

}  // namespace etendue::patterns
