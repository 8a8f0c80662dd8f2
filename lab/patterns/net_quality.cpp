#include "patterns/net_quality.h"

#include <algorithm>
#include <cmath>

namespace etendue::patterns {
namespace {

// Coordinates are multiples of a power of the base, rounded; a point just below the side of a cell is on it.
int cell_of(double x, int cells) {
  constexpr double kRounding = 1e-9;
  return std::clamp(static_cast<int>(std::floor(x * cells + kRounding)), 0, cells - 1);
}

// m, if there are base^m points.
std::optional<int> logarithm(size_t points, int base) {
  int m = 0;
  size_t power = 1;
  for (; power < points; ++m) power *= static_cast<size_t>(base);
  return power == points ? std::optional(m) : std::nullopt;
}

int power_of(int base, int exponent) { return static_cast<int>(std::lround(std::pow(base, exponent))); }

// Whether each box of a grid with `cells[k]` intervals along axis k contains the same number of points.
bool fills_boxes_evenly(const std::vector<std::vector<double>>& points, const std::vector<int>& cells) {
  size_t boxes = 1;
  for (const int c : cells) boxes *= static_cast<size_t>(c);
  std::vector<size_t> counts(boxes);
  for (const auto& p : points) {
    size_t box = 0;
    for (size_t k = 0; k < cells.size(); ++k)
      box = box * static_cast<size_t>(cells[k]) + static_cast<size_t>(cell_of(p[k], cells[k]));
    ++counts[box];
  }
  return std::ranges::all_of(counts, [&](size_t c) { return c * boxes == points.size(); });
}

// Whether all grids whose numbers of intervals are powers of the base with a sum of exponents `digits` are filled evenly.
// The exponents of the axes from `axis` on are varied.
bool fills_all_grids(const std::vector<std::vector<double>>& points, int base, int digits, size_t axis,
                     std::vector<int>& cells) {
  if (axis + 1 == cells.size()) {
    cells[axis] = power_of(base, digits);
    return fills_boxes_evenly(points, cells);
  }
  for (int k = 0; k <= digits; ++k) {
    cells[axis] = power_of(base, k);
    if (!fills_all_grids(points, base, digits - k, axis + 1, cells)) return false;
  }
  return true;
}

}  // namespace

std::optional<int> net_quality(const std::vector<std::vector<double>>& points, int base) {
  if (base < 2 || points.empty() || points.front().empty()) return {};
  const auto m = logarithm(points.size(), base);
  if (!m) return {};
  std::vector<int> cells(points.front().size());
  for (int t = 0; t < *m; ++t)
    if (fills_all_grids(points, base, *m - t, 0, cells)) return t;
  return m;
}

std::optional<int> net_quality(const PointSet& points, int base) {
  std::vector<std::vector<double>> coordinates;
  for (const PlanePoint& p : points) coordinates.push_back({p[0], p[1]});
  return net_quality(coordinates, base);
}

}  // namespace etendue::patterns
