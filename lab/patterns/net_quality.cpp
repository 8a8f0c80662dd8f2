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

}  // namespace

bool fills_evenly(const PointSet& points, int columns, int rows) {
  std::vector<size_t> counts(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  for (const PlanePoint& p : points)
    ++counts[static_cast<size_t>(cell_of(p[1], rows)) * static_cast<size_t>(columns) +
             static_cast<size_t>(cell_of(p[0], columns))];
  return std::ranges::all_of(counts, [&](size_t c) { return c * counts.size() == points.size(); });
}

std::optional<int> net_quality(const PointSet& points, int base) {
  if (base < 2 || points.empty()) return {};
  const auto m = logarithm(points.size(), base);
  if (!m) return {};
  const auto power = [&](int k) { return static_cast<int>(std::lround(std::pow(base, k))); };
  for (int t = 0; t < *m; ++t) {
    bool is_net = true;
    for (int k = 0; k <= *m - t && is_net; ++k) is_net = fills_evenly(points, power(k), power(*m - t - k));
    if (is_net) return t;
  }
  return m;
}

}  // namespace etendue::patterns
