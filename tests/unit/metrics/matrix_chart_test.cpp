// Charts of matrices: cells, empty cells, and the reduction of large matrices.
#include "metrics/matrix_chart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etendue::metrics {
namespace {

constexpr size_t kScaleCells = 32;

size_t polygons(const Drawing& drawing) {
  size_t count = 0;
  for (const auto& shape : drawing.shapes) count += std::holds_alternative<Polygon>(shape) ? 1 : 0;
  return count;
}

TEST(MatrixChart, HasACellForEachFiniteNumber) {
  const MatrixChart chart{.title = "m", .x_label = "x", .y_label = "y", .rows = {{1, 2, 3}, {4, NAN, 6}}};
  EXPECT_EQ(polygons(matrix_drawing(chart, {})), 5 + kScaleCells);
}

TEST(MatrixChart, LargeMatricesAreReduced) {
  MatrixChart chart{.title = "m", .x_label = "x", .y_label = "y", .rows = {}};
  chart.rows.assign(200, std::vector<double>(130, 1.0));
  EXPECT_EQ(polygons(matrix_drawing(chart, {})), kMostCells * kMostCells + kScaleCells);
}

TEST(MatrixChart, WithoutNumbersNothingIsDrawn) { EXPECT_TRUE(matrix_drawing({}, {}).shapes.empty()); }

}  // namespace
}  // namespace etendue::metrics
