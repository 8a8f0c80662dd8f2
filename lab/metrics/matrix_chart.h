// Chart of a matrix, or of other numbers on a grid, as coloured cells with a scale.
#pragma once
#include <string>
#include <vector>

#include "metrics/convergence_chart.h"
#include "metrics/drawing.h"

namespace etendue::metrics {

struct MatrixChart {
  std::string title, x_label, y_label;
  std::vector<std::vector<double>> rows;  // of equal length, from top to bottom; cells that are not finite are empty
};

// Matrices with more rows or columns are reduced to at most this number by averaging.
inline constexpr size_t kMostCells = 64;

// Values are coloured from 0 to the largest one, or around 0 if some are negative. Of the options, `embedded` draws neither
// title nor names of the axes; width, height and palette are as for convergence_chart.
Drawing matrix_drawing(const MatrixChart& chart, const ChartOptions& options);

}  // namespace etendue::metrics
