#include "patterns/distances.h"

#include <algorithm>
#include <cmath>

namespace etendue::patterns {
namespace {

template <class Set, class Distance>
double least_over_pairs(const Set& points, Distance&& distance) {
  double least = INFINITY;
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t j = 0; j < i; ++j) least = std::min(least, distance(points[i], points[j]));
  return least;
}

double along_circle(double a, double b) { return std::abs(a - b - std::round(a - b)); }

// The Euclidean norm of the distances along the axes.
template <class Along>
double cube_distance(const std::vector<double>& p, const std::vector<double>& q, Along&& along) {
  double squares = 0;
  for (size_t k = 0; k < p.size(); ++k) squares += along(p[k], q[k]) * along(p[k], q[k]);
  return std::sqrt(squares);
}

// The part of a convex polygon that is not nearer to `other` than to `point`.
PointSet nearer_part(const PointSet& polygon, const PlanePoint& point, const PlanePoint& other) {
  const double nx = other[0] - point[0], ny = other[1] - point[1];
  const double limit = 0.5 * (other[0] * other[0] + other[1] * other[1] - point[0] * point[0] - point[1] * point[1]);
  const auto beyond = [&](const PlanePoint& p) { return nx * p[0] + ny * p[1] - limit; };
  PointSet part;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const PlanePoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = beyond(a), db = beyond(b);
    if (da <= 0) part.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      const double t = da / (da - db);
      part.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
  }
  return part;
}

}  // namespace

double least_distance(const PointSet& points) {
  return least_over_pairs(
      points, [](const PlanePoint& p, const PlanePoint& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); });
}

double toroidal_distance(const PlanePoint& p, const PlanePoint& q) {
  return std::hypot(along_circle(p[0], q[0]), along_circle(p[1], q[1]));
}

double least_toroidal_distance(const PointSet& points) { return least_over_pairs(points, toroidal_distance); }

double least_distance(const CubePoints& points) {
  const auto along = [](double a, double b) { return std::abs(a - b); };
  return least_over_pairs(points, [&](const auto& p, const auto& q) { return cube_distance(p, q, along); });
}

double least_toroidal_distance(const CubePoints& points) {
  return least_over_pairs(points, [](const auto& p, const auto& q) { return cube_distance(p, q, along_circle); });
}

std::vector<PointSet> voronoi_cells(const PointSet& points) {
  std::vector<PointSet> cells;
  for (const PlanePoint& p : points) {
    PointSet cell{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const PlanePoint& q : points)
      if (q != p) cell = nearer_part(cell, p, q);
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace etendue::patterns
