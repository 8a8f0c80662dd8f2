#include "patterns/cube_discrepancy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace etendue::patterns {
namespace {

// Coordinates of grid nodes along one axis, ascending, the last one 1.
using Axis = std::vector<double>;

// At most `most` of the coordinates of the points along an axis, and 1.
Axis axis_of(const CubePoints& points, size_t axis, size_t most) {
  Axis values{1};
  for (const auto& p : points) values.push_back(p[axis]);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() <= most) return values;
  Axis thinned;
  for (size_t k = 1; k <= most; ++k) thinned.push_back(values[k * values.size() / most - 1]);
  return thinned;
}

// Numbers of points in the boxes from the origin to each node of the grid, the last axis varying fastest.
class NodeCounts {
 public:
  // `closed`: points on the upper sides of a box belong to it.
  NodeCounts(const CubePoints& points, const std::vector<Axis>& grid, bool closed) {
    size_t nodes = 1;
    for (const Axis& axis : grid) nodes *= axis.size();
    counts_.resize(nodes);
    for (const auto& p : points)
      if (const auto node = first_node(p, grid, closed)) ++counts_[*node];
    sum_along_axes(grid);
  }

  uint32_t operator[](size_t node) const { return counts_[node]; }
  size_t size() const { return counts_.size(); }

 private:
  // The smallest node whose box contains the point; none if no box does.
  static std::optional<size_t> first_node(const std::vector<double>& p, const std::vector<Axis>& grid, bool closed) {
    size_t node = 0;
    for (size_t k = 0; k < grid.size(); ++k) {
      const Axis& axis = grid[k];
      const auto at = closed ? std::ranges::lower_bound(axis, p[k]) : std::ranges::upper_bound(axis, p[k]);
      if (at == axis.end()) return {};
      node = node * axis.size() + static_cast<size_t>(at - axis.begin());
    }
    return node;
  }

  void sum_along_axes(const std::vector<Axis>& grid) {
    size_t stride = 1;
    for (size_t k = grid.size(); k-- > 0; stride *= grid[k].size())
      for (size_t node = 0; node < counts_.size(); ++node)
        if (node / stride % grid[k].size() != 0) counts_[node] += counts_[node - stride];
  }

  std::vector<uint32_t> counts_;
};

// A node, and the node below it on every axis.
struct Cell {
  double volume = 1, volume_below = 1;  // of the boxes from the origin
  size_t below = 0;
  bool at_origin = false;  // a coordinate of the node below is 0
};

Cell cell_at(size_t node, const std::vector<Axis>& grid) {
  Cell cell;
  size_t stride = 1, rest = node, step = 0;
  for (size_t k = grid.size(); k-- > 0; stride *= grid[k].size()) {
    const size_t i = rest % grid[k].size();
    rest /= grid[k].size();
    cell.volume *= grid[k][i];
    cell.volume_below *= i == 0 ? 0 : grid[k][i - 1];
    cell.at_origin |= i == 0;
    step += stride;
  }
  cell.below = cell.at_origin ? 0 : node - step;
  return cell;
}

}  // namespace

Bounds star_discrepancy_bounds(const CubePoints& points, double most_corners) {
  const size_t dimension = points.front().size();
  const auto most = static_cast<size_t>(std::pow(most_corners, 1.0 / static_cast<double>(dimension)) + 1e-9);
  std::vector<Axis> grid;
  for (size_t k = 0; k < dimension; ++k) grid.push_back(axis_of(points, k, most));
  const NodeCounts open(points, grid, false), closed(points, grid, true);
  const auto share = [&](uint32_t count) { return count / static_cast<double>(points.size()); };
  Bounds bounds;
  for (size_t node = 0; node < open.size(); ++node) {
    const Cell cell = cell_at(node, grid);
    const double least = cell.at_origin ? 0 : share(closed[cell.below]), most_share = share(open[node]);
    bounds.lower = std::max({bounds.lower, share(closed[node]) - cell.volume, cell.volume - most_share});
    bounds.upper = std::max({bounds.upper, most_share - cell.volume_below, cell.volume - least});
  }
  bounds.upper = std::max(bounds.upper, bounds.lower);
  return bounds;
}

double l2_star_discrepancy(const CubePoints& points) {
  const auto n = static_cast<double>(points.size());
  const auto s = static_cast<int>(points.front().size());
  double single = 0, pairs = 0;
  for (const auto& p : points) {
    double product = 1;
    for (const double x : p) product *= 1 - x * x;
    single += product;
    for (const auto& q : points) {
      double pair = 1;
      for (size_t k = 0; k < p.size(); ++k) pair *= 1 - std::max(p[k], q[k]);
      pairs += pair;
    }
  }
  return std::sqrt(std::max(0.0, std::pow(3.0, -s) - std::ldexp(single, 1 - s) / n + pairs / (n * n)));
}

}  // namespace etendue::patterns
