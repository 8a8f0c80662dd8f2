// Point sets and sequences without randomisation, as the samplers of the same names begin from.
#pragma once
#include "patterns/point_set.h"

namespace etendue::patterns {

PointSet halton_points(uint32_t count, uint32_t base_x = 2, uint32_t base_y = 3);
PointSet hammersley_points(uint32_t count);  // base 2
PointSet zaremba_points(uint32_t count);     // bases 2 and 3
// side^2 points; `offset` is the place of a point in its cell, from 0 to 1.
PointSet regular_grid_points(uint32_t side, double offset = 0.5);
// An even number of rows, so that the grid is periodic.
PointSet hexagonal_grid_points(uint32_t columns);

}  // namespace etendue::patterns
