// Distances between the points of a set.
#pragma once
#include "patterns/cube_discrepancy.h"
#include "patterns/point_set.h"

namespace etendue::patterns {

// The smallest distance between two points; infinite for fewer than two. On a torus, opposite sides of the unit square
// are joined.
double least_distance(const PointSet& points);
double least_toroidal_distance(const PointSet& points);
double toroidal_distance(const PlanePoint& p, const PlanePoint& q);
// The same in the unit cube of any dimension.
double least_distance(const CubePoints& points);
double least_toroidal_distance(const CubePoints& points);

// The Voronoi cell of each point: the corners, in order, of the part of the unit square that is nearer to it than to all
// others. Time O(N^2).
std::vector<PointSet> voronoi_cells(const PointSet& points);

}  // namespace etendue::patterns
