// How evenly a point set fills elementary intervals.                           [Lang, def. 7.14-7.17; Niederreiter 1992]
#pragma once
#include <optional>

#include "patterns/point_set.h"

namespace etendue::patterns {

// The smallest t with which the set is a (t, m, 2)-net in this base, from 0 to m; none unless there are base^m points.
std::optional<int> net_quality(const PointSet& points, int base);

// The same for points of the unit cube of any dimension: a (t, m, s)-net. All points have the same number of coordinates.
std::optional<int> net_quality(const std::vector<std::vector<double>>& points, int base);

}  // namespace etendue::patterns
