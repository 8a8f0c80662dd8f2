// The quality of point sets in numbers.
#pragma once
#include <string>

#include "patterns/cube_discrepancy.h"
#include "patterns/point_set.h"

namespace etendue::patterns {

struct QualityValue {
  std::string name;
  double mean = 0;            // over the sets
  double standard_error = 0;  // of the mean; 0 for one set
};

// Larger sets have no extreme discrepancy, whose time grows with the cube of the number of points.
inline constexpr size_t kMostPointsOfExtreme = 512;
// Larger sets have neither discrepancies nor distances.
inline constexpr size_t kMostPointsOfPairs = 16384;

// Star, extreme and L2 star discrepancy, smallest distances, t in base 2 of sets of 2^m points, and the errors of the
// integrals of x y and exp(x + y) with their bounds of Koksma and Hlawka, i.e. the variation times the star discrepancy
// [Lang, eq. 7.27]. All sets have the same size; there is at least one.
std::vector<QualityValue> report_of(const std::vector<PointSet>& sets);

// Of sets in three or more dimensions: bounds of the star discrepancy, L2 star discrepancy, smallest distances, t in base 2
// of sets of 2^m points, and the error of the integral of the product of all coordinates.
std::vector<QualityValue> report_of(const std::vector<CubePoints>& sets);

}  // namespace etendue::patterns
