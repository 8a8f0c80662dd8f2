#include "patterns/known_sets.h"

#include "sampling/halton.h"
#include "sampling/point_sets/hexagonal_grid.h"
#include "sampling/point_sets/zaremba.h"

namespace etendue::patterns {

PointSet halton_points(uint32_t count, uint32_t base_x, uint32_t base_y) {
  return point_set(count, [&](uint32_t i) {
    return PlanePoint{HaltonSampler::radical_inverse(i, base_x), HaltonSampler::radical_inverse(i, base_y)};
  });
}

PointSet hammersley_points(uint32_t count) {
  return point_set(count, [&](uint32_t i) {
    return PlanePoint{static_cast<double>(i) / count, HaltonSampler::radical_inverse(i, 2)};
  });
}

PointSet zaremba_points(uint32_t count) {
  return point_set(count, [](uint32_t i) {
    return PlanePoint{ZarembaSampler::inverse(i, 2), ZarembaSampler::inverse(i, 3)};
  });
}

PointSet regular_grid_points(uint32_t side, double offset) {
  return point_set(side * side, [&](uint32_t i) {
    return PlanePoint{(i % side + offset) / side, (i / side + offset) / side};
  });
}

PointSet hexagonal_grid_points(uint32_t columns) {
  const uint32_t rows = HexagonalGridSampler::rows(columns);
  return point_set(columns * rows, [&](uint32_t i) {
    const uint32_t row = i / columns;
    return PlanePoint{(i % columns + 0.25 + 0.5 * (row % 2)) / columns, (row + 0.5) / rows};
  });
}

}  // namespace etendue::patterns
