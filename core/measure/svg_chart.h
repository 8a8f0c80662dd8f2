// The chart of error over time: log-log, a line and a band for each method, guides for known slopes.
#pragma once
#include <span>
#include <string>

#include "measure/convergence.h"
#include "measure/drawing.h"

namespace etendue::measure {

struct ChartOptions {
  std::string title;
  Abscissa along = Abscissa::seconds;
  ErrorKind kind = ErrorKind::rmse;
  int width = 900, height = 520;  // pixels, without the legend below
  // The reference's standard error in the unit of the chart: a line below which nothing can be told. 0 draws none.
  double reference_error = 0;
  ReferenceNoise noise = {};  // what was taken off the curves: fitted slopes trust what it made uncertain less
};

// Median lines, bands of 10 % to 90 %, a dot at each step whose hint says method, time, samples and error; a legend
// with fitted slopes. Methods without a point that a logarithm can be taken of stand in the legend, without a line.
Drawing chart_of(std::span<const MethodCurves> methods, const ChartOptions& options);

// The colour of the method that stands at this place, as CSS has it.
std::string method_color(size_t method);

// The same as an <svg> element.
std::string svg_chart(std::span<const MethodCurves> methods, const ChartOptions& options);

}  // namespace etendue::measure
