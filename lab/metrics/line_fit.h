// Weighted least-squares fit of a straight line.
//
// The weights are known up to a common factor, which is estimated from the residuals with n - 2 degrees of freedom
// [Press et al. 2007, sec. 15.2].
#pragma once
#include <span>

namespace etendue::metrics {

struct LinePoint {
  double x, y;
  double weight = 1;  // inversely proportional to the variance of y; points without weight are ignored
};

struct LineFit {
  double slope = 0, intercept = 0;
  // Standard error of the slope if the errors of the points are independent; 0 for two points.
  double slope_error = 0;
  bool known = false;  // true for at least two points with different x
};

LineFit fit_line(std::span<const LinePoint> points);

}  // namespace etendue::metrics
