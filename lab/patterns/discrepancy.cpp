#include "patterns/discrepancy.h"

#include <algorithm>
#include <cmath>

namespace etendue::patterns {
namespace {

// The different coordinates along an axis in ascending order, with the given ends.
std::vector<double> coordinates(const PointSet& points, size_t axis, std::initializer_list<double> ends) {
  std::vector<double> values(ends);
  for (const PlanePoint& p : points) values.push_back(p[axis]);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

PointSet sorted_by_y(PointSet points) {
  std::ranges::sort(points, {}, [](const PlanePoint& p) { return p[1]; });
  return points;
}

// The largest excess of points over area among the closed boxes with these sides in x. `points` is sorted by y.
double largest_excess(const PointSet& points, double x0, double x1) {
  const double share = 1 / static_cast<double>(points.size()), width = x1 - x0;
  double below = 0;         // share of the points of the slab that have been visited
  double least = INFINITY;  // of (share below y - width y) at the lower side of a box
  double most = 0;
  for (const PlanePoint& p : points) {
    if (p[0] < x0 || p[0] > x1) continue;
    least = std::min(least, below - width * p[1]);
    below += share;
    most = std::max(most, below - width * p[1] - least);
  }
  return most;
}

// The largest excess of area over points among the open boxes with these sides in x.
double largest_deficit(const PointSet& points, double x0, double x1) {
  const double share = 1 / static_cast<double>(points.size()), width = x1 - x0;
  double below = 0, least = 0, most = 0;
  for (size_t i = 0; i < points.size();) {
    const double y = points[i][1];
    double at_y = 0;
    for (; i < points.size() && points[i][1] == y; ++i)
      if (points[i][0] > x0 && points[i][0] < x1) at_y += share;
    if (at_y == 0) continue;
    most = std::max(most, width * y - below - least);
    below += at_y;
    least = std::min(least, width * y - below);
  }
  return std::max(most, width - below - least);
}

}  // namespace

double star_discrepancy(const PointSet& points) {
  const PointSet sorted = sorted_by_y(points);
  const double share = 1 / static_cast<double>(points.size());
  double most = 0;
  // The supremum is approached by boxes whose upper sides contain points or are those of the unit square.
  for (const double x : coordinates(points, 0, {1})) {
    double open = 0, closed = 0;  // shares of the points with smaller, or smaller and equal, coordinates
    for (size_t i = 0; i < sorted.size();) {
      const double y = sorted[i][1];
      most = std::max(most, x * y - open);
      for (; i < sorted.size() && sorted[i][1] == y; ++i) {
        open += sorted[i][0] < x ? share : 0;
        closed += sorted[i][0] <= x ? share : 0;
      }
      most = std::max(most, closed - x * y);
    }
    most = std::max(most, x - open);
  }
  return most;
}

double extreme_discrepancy(const PointSet& points) {
  const PointSet sorted = sorted_by_y(points);
  const auto sides = coordinates(points, 0, {0, 1});
  double most = 0;
  for (size_t i = 0; i < sides.size(); ++i)
    for (size_t j = i; j < sides.size(); ++j)
      most = std::max({most, largest_excess(sorted, sides[i], sides[j]), largest_deficit(sorted, sides[i], sides[j])});
  return most;
}

double l2_star_discrepancy(const PointSet& points) {
  const auto n = static_cast<double>(points.size());
  double single = 0, pairs = 0;
  for (const PlanePoint& p : points) {
    single += (1 - p[0] * p[0]) * (1 - p[1] * p[1]);
    for (const PlanePoint& q : points) pairs += (1 - std::max(p[0], q[0])) * (1 - std::max(p[1], q[1]));
  }
  return std::sqrt(std::max(0.0, 1.0 / 9 - single / (2 * n) + pairs / (n * n)));
}

double halton_bound(double points) {
  const double n = points;
  return 2 / n + (std::log(n) / std::log(4) + 1.5) * (std::log(n) / std::log(3) + 2) / n;
}

double hammersley_bound(double points) { return (std::log(points) / std::log(4) + 3.5) / points; }

}  // namespace etendue::patterns
