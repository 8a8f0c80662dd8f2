#include "metrics/line_fit.h"

#include <cmath>
#include <cstddef>

namespace etendue::metrics {
namespace {

struct Sums {
  double weight = 0, x = 0, y = 0;
  size_t points = 0;
};

Sums sums_of(std::span<const LinePoint> points) {
  Sums s;
  for (const auto& p : points) {
    if (!(p.weight > 0)) continue;
    s.weight += p.weight;
    s.x += p.weight * p.x;
    s.y += p.weight * p.y;
    ++s.points;
  }
  return s;
}

}  // namespace

LineFit fit_line(std::span<const LinePoint> points) {
  const Sums sums = sums_of(points);
  if (sums.points < 2) return {};
  const double x0 = sums.x / sums.weight, y0 = sums.y / sums.weight;
  double xx = 0, xy = 0;
  for (const auto& p : points) {
    if (!(p.weight > 0)) continue;
    xx += p.weight * (p.x - x0) * (p.x - x0);
    xy += p.weight * (p.x - x0) * (p.y - y0);
  }
  if (!(xx > 0)) return {};
  LineFit fit;
  fit.slope = xy / xx;
  fit.intercept = y0 - fit.slope * x0;
  fit.known = true;
  double residual = 0;
  for (const auto& p : points)
    if (p.weight > 0) residual += p.weight * std::pow(p.y - fit.intercept - fit.slope * p.x, 2);
  if (sums.points > 2) fit.slope_error = std::sqrt(residual / static_cast<double>(sums.points - 2) / xx);
  return fit;
}

}  // namespace etendue::metrics
