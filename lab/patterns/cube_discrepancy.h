// Discrepancies of point sets in the unit cube of any dimension.        [Lang, def. 7.2, eq. 7.6-7.16; Thiemard 2001]
#pragma once
#include <vector>

namespace etendue::patterns {

// Points of [0, 1)^s; all have the same number s >= 1 of coordinates.
using CubePoints = std::vector<std::vector<double>>;

struct Bounds {
  double lower = 0, upper = 0;
};

// Bounds of the star discrepancy, the largest difference between the share of points in a box with a corner at the origin
// and its volume. Boxes with their upper corners on a grid have exact values; those between are bounded by their
// neighbours. The grid consists of the coordinates of the points, thinned so that it has at most `most_corners` nodes:
// without thinning both bounds are the star discrepancy. Time O(s most_corners + s N log N), memory 8 bytes per node. At
// least one point; most_corners >= 2^s.
Bounds star_discrepancy_bounds(const CubePoints& points, double most_corners = 1 << 22);

// The root of the mean square over boxes with a corner at the origin [Warnock 1972]. Time O(s N^2). At least one point.
double l2_star_discrepancy(const CubePoints& points);

}  // namespace etendue::patterns
