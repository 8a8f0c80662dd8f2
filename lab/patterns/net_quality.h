// How evenly a point set fills elementary intervals.                           [Lang, def. 7.14-7.17; Niederreiter 1992]
#pragma once
#include <optional>

#include "patterns/point_set.h"

namespace etendue::patterns {

// Whether every elementary interval of b^k x b^l equal cells, i.e. all cells of a grid, contains the same number of
// points. Points on a common side belong to the upper cell.
bool fills_evenly(const PointSet& points, int columns, int rows);

// The smallest t with which the set is a (t, m, 2)-net in this base, from 0 to m; none unless there are base^m points.
std::optional<int> net_quality(const PointSet& points, int base);

}  // namespace etendue::patterns
