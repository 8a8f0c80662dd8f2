// A density sampled at the nodes of a regular grid, with bounds of coarse cells for delta tracking.
//
// The grid fills the unit cube: the nodes of an axis lie at equal distances from 0 to 1, and the density between them
// is trilinear. Coarse cells consist of several voxels. Their bounds hold for every point of the cell, because
// trilinear interpolation stays between the values at the nodes.
#pragma once
#include <array>
#include <vector>

#include "base/vec.h"

namespace etendue {

using GridSize = std::array<int, 3>;

// Values at the nodes of a grid; x varies fastest.
struct GridValues {
  GridSize nodes{2, 2, 2};         // at least 2 along each axis
  std::vector<float> density;      // finite and not negative
  std::vector<float> temperature;  // relative to the highest one, in [0, 1]; empty if the density takes its place
};

// The part of a ray between two parameters, in the coordinates of the unit cube.
struct GridRay {
  Vec3 origin{0}, direction{0};
  float from = 0, to = 0;

  Vec3 at(float t) const { return origin + direction * t; }
};

class DensityGrid {
 public:
  explicit DensityGrid(GridValues values);

  const GridSize& nodes() const { return values_.nodes; }
  float highest() const { return highest_; }
  size_t memory() const;  // bytes

  // At a point of the unit cube; points outside take the value of the nearest point inside.
  float density(const Vec3& p) const { return interpolated(values_.density, p); }
  // In [0, 1]; in proportion to the density if the grid has no temperatures.
  float temperature(const Vec3& p) const;

  // The bounds of the density in a coarse cell, and its mean.
  struct Cell {
    float lowest = 0, highest = 0, mean = 0;
  };

  // Coarse cells along each axis, and per unit of length. The last cell of an axis may have fewer voxels.
  const GridSize& cell_counts() const { return cell_counts_; }
  const Vec3& cells_per_unit() const { return cells_per_unit_; }

  // The part of a ray inside the unit cube; empty (from >= to) if it misses the cube.
  static GridRay clipped(GridRay ray);

  // Calls visit(from, to, cell) for the coarse cells along a clipped ray, from its start, until it returns false.
  template <class Visit>
  void for_each_cell(const GridRay& ray, Visit&& visit) const {
    traverse(ray, cells_per_unit_, cell_counts_,
             [&](float from, float to, size_t cell) { return visit(from, to, cells_[cell]); });
  }

  // Calls visit(from, to, cell) for the cells of a division of the unit cube along a clipped ray, until it returns
  // false. Cells are numbered with x varying fastest.
  template <class Visit>
  static void traverse(const GridRay& ray, const Vec3& cells_per_unit, const GridSize& counts, Visit&& visit);

  // The integral of the density over the parameter of a clipped ray. Exact up to rounding: along a ray, the density in
  // a voxel is a cubic polynomial.
  double integral(const GridRay& ray) const;

 private:
  float interpolated(const std::vector<float>& values, const Vec3& p) const;
  void find_cells();

  GridValues values_;
  Vec3 voxels_;          // per axis
  Vec3 cells_per_unit_;  // coarse cells per length; not an integer if the last cell has fewer voxels
  GridSize cell_counts_{};
  std::vector<Cell> cells_;
  float highest_ = 0;
};

// The digital differential analyser of [Amanatides and Woo 1987]. Crossings are computed from the indices of the cells,
// so that rounding errors do not accumulate.
template <class Visit>
void DensityGrid::traverse(const GridRay& ray, const Vec3& cells_per_unit, const GridSize& counts, Visit&& visit) {
  if (!(ray.from < ray.to)) return;
  const Vec3 origin = ray.origin * cells_per_unit, direction = ray.direction * cells_per_unit;
  const Vec3 start = origin + direction * ray.from;
  int cell[3], step[3];
  float crossing[3];
  const auto next_crossing = [&](int axis) {
    if (step[axis] == 0) return kInfinity;
    const int plane = step[axis] > 0 ? cell[axis] + 1 : cell[axis];
    return (static_cast<float>(plane) - origin[axis]) / direction[axis];
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto count = counts[static_cast<size_t>(axis)];
    cell[axis] = static_cast<int>(std::clamp(start[axis], 0.0f, static_cast<float>(count - 1)));
    step[axis] = direction[axis] > 0 ? 1 : direction[axis] < 0 ? -1 : 0;
    crossing[axis] = next_crossing(axis);
  }
  for (float from = ray.from; from < ray.to;) {
    const int axis =
        crossing[0] < crossing[1] ? (crossing[0] < crossing[2] ? 0 : 2) : (crossing[1] < crossing[2] ? 1 : 2);
    const float to = std::clamp(crossing[axis], from, ray.to);
    const size_t index =
        static_cast<size_t>(cell[0]) +
        static_cast<size_t>(counts[0]) *
            (static_cast<size_t>(cell[1]) + static_cast<size_t>(counts[1]) * static_cast<size_t>(cell[2]));
    if (to > from && !visit(from, to, index)) return;
    if (!(crossing[axis] < ray.to)) return;
    from = to;
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= counts[static_cast<size_t>(axis)]) {
      // Rounding: the rest of the ray lies in the last cell.
      cell[axis] -= step[axis];
      step[axis] = 0;
    }
    crossing[axis] = next_crossing(axis);
  }
}

}  // namespace etendue
