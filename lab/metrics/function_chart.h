// Chart of functions, samples and histograms: curves over linear or logarithmic axes, with optional bands.
#pragma once
#include <string>
#include <vector>

#include "metrics/convergence_chart.h"
#include "metrics/drawing.h"

namespace etendue::metrics {

enum class CurveStyle {
  line,
  dashed,  // of theory
  dots,
  bars,  // of a histogram: each reaches from its x to that of the next point, the last one has no height
};

struct Interval {
  double low, high;
};

struct FunctionCurve {
  std::string name;
  CurveStyle style = CurveStyle::line;
  std::vector<Point> points;
  std::vector<Interval> band = {};  // of y at each point; may be empty
};

struct FunctionChart {
  std::string title, x_label, y_label;
  std::vector<FunctionCurve> curves;
  bool logarithmic_x = false, logarithmic_y = false;  // points without a logarithm are left out
};

// Draws title, axes, curves and a legend. Of the options, `embedded` draws neither title and names of the axes nor
// legend; width, height and
// palette are as for convergence_chart.
Drawing function_drawing(const FunctionChart& chart, const ChartOptions& options);

}  // namespace etendue::metrics
