// A straight line through points whose ordinates are uncertain.
//
// Source: weighted least squares with weights known up to a factor; the factor comes from the residuals (W. H. Press et
// al., "Numerical Recipes", 3rd ed. 2007, 15.2, with the scatter estimated from n - 2 degrees of freedom).
#pragma once
#include <span>

namespace etendue::metrics {

struct LinePoint {
  double x, y;
  double weight = 1;  // inversely proportional to the variance of y
};

struct LineFit {
  double slope = 0, intercept = 0;
  // Of the slope, for points that err independently; zero where nothing is left over to tell.
  double slope_error = 0;
  bool known = false;  // two points at least, at different x
};

LineFit fit_line(std::span<const LinePoint> points);

}  // namespace etendue::metrics
