// Discrepancies of point sets in the unit square: the largest or mean difference between the share of points in a box
// and its area.                                                          [Lang, def. 7.2, eq. 7.6-7.16; Warnock 1972]
//
// All values are exact up to rounding. Sets must not be empty.
#pragma once
#include "patterns/point_set.h"

namespace etendue::patterns {

// Boxes with a corner at the origin. Time O(N^2).
double star_discrepancy(const PointSet& points);

// All axis-parallel boxes. Time O(N^3).
double extreme_discrepancy(const PointSet& points);

// The root of the mean square over boxes with a corner at the origin. Time O(N^2).
double l2_star_discrepancy(const PointSet& points);

// The bound of the star discrepancy of the first N >= 1 points of the Halton sequence in bases 2 and 3, and that of the
// Hammersley set of N points in base 2 [Lang, eq. 7.40, 7.47].
double halton_bound(double points);
double hammersley_bound(double points);

}  // namespace etendue::patterns
