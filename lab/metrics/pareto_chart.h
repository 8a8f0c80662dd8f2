// Chart of the errors and the costs of methods at the end of their curves, with the Pareto front: the methods that no
// other one beats in both.
#pragma once
#include <span>
#include <vector>

#include "metrics/convergence_chart.h"

namespace etendue::metrics {

struct ParetoPoint {
  size_t method = 0;     // index
  double x = 0;          // seconds or samples per pixel, the median of the complete repeats
  double error = 0;      // the median in the measure of the chart
  bool is_best = false;  // no method has at most this error at a lower cost, or a lower error at most at this cost
};

// The ends of the curves (curve_end), in the order of the methods. Methods without a complete repeat, and those whose error
// is lost in the noise of the reference, have none.
std::vector<ParetoPoint> pareto_points(std::span<const MethodCurves> methods, Abscissa abscissa,
                                       film::ErrorMeasure measure);

// Axes and guides as in convergence_chart: methods on a line of slope -1/2 have the same efficiency. The names of the best
// methods are next to their dots, as far as they do not cover each other.
Drawing pareto_chart(std::span<const MethodCurves> methods, const ChartOptions& options);
ChartFrame pareto_frame(std::span<const MethodCurves> methods, const ChartOptions& options);

}  // namespace etendue::metrics
