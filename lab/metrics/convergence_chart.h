// Chart of error over time or samples: log-log axes, a median line and a band for each method, guides for known slopes.
#pragma once
#include <span>
#include <string>

#include "metrics/convergence.h"
#include "metrics/drawing.h"
#include "metrics/log_axis.h"

namespace etendue::metrics {

// Colours of everything but the curves.
struct ChartPalette {
  Color text{34, 34, 34}, secondary_text{120, 120, 120}, grid{205, 205, 205}, minor_grid{236, 236, 236};
};

struct ChartOptions {
  std::string title;
  Abscissa abscissa = Abscissa::seconds;
  film::ErrorMeasure measure = film::ErrorMeasure::rmse;
  int width = 900, height = 520;  // pixels, without the legend below
  // The standard error of the reference in the unit of the chart, drawn as a horizontal line; 0 draws none.
  double reference_error = 0;
  ReferenceNoise noise = {};  // the noise that was subtracted from the curves; weights the fitted slopes
  // For a panel that shows title and legend itself: draws neither, and dots only at the ends of the curves.
  bool embedded = false;
  // What `ErrorPoint::spp` counts, if it is not samples per pixel: "evaluations".
  std::string work_label = {};
  std::string error_label = {};  // empty: the label of the measure
  double x_extent = 0;           // minimum end of the abscissa, so that growing curves do not rescale it
  ChartPalette palette = {};
};

// The colour of the method with this index. After the last colour they repeat, with dashed lines.
Color method_color(size_t method);

// The plot area and the axes of a chart.
struct ChartFrame {
  double left, right, top, bottom;
  LogAxis x, y;
};
ChartFrame chart_frame(std::span<const MethodCurves> methods, const ChartOptions& options);

// Median lines and bands from the 10 % to the 90 % quantile of the complete repeats, dots with tooltips (method, time or
// samples, error), and a legend with fitted slopes, which states how many repeats are complete unless all are. Methods without a point that has a logarithm appear in the legend only.
Drawing convergence_chart(std::span<const MethodCurves> methods, const ChartOptions& options);

}  // namespace etendue::metrics
