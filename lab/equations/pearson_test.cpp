#include "equations/pearson_test.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>
#include <vector>

namespace etendue::equations {

ChiSquareTest chi_square_test(std::span<const double> counts, std::span<const double> expected) {
  constexpr double kSmallestExpectation = 5;
  struct Cell {
    double count = 0, expectation = 0;
  };
  Cell pooled;
  std::vector<Cell> cells;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] >= kSmallestExpectation) {
      cells.push_back({counts[i], expected[i]});
    } else {
      pooled.count += counts[i];
      pooled.expectation += expected[i];
    }
  }
  ChiSquareTest test;
  // Counts in cells that the density does not reach are impossible.
  if (pooled.expectation == 0 && pooled.count > 0) test.statistic = INFINITY;
  if (pooled.expectation >= kSmallestExpectation || (cells.empty() && pooled.expectation > 0)) {
    cells.push_back(pooled);
  } else if (!cells.empty()) {
    Cell& smallest = *std::ranges::min_element(cells, {}, &Cell::expectation);
    smallest.count += pooled.count;
    smallest.expectation += pooled.expectation;
  }
  for (const Cell& cell : cells)
    test.statistic += (cell.count - cell.expectation) * (cell.count - cell.expectation) / cell.expectation;
  test.degrees = std::max(1, static_cast<int>(cells.size()) - 1);
  test.p_value = chi_square_survival(test.statistic, test.degrees);
  return test;
}

double chi_square_survival(double statistic, int degrees) {
  return std::isfinite(statistic) ? Eigen::numext::igammac(degrees / 2.0, statistic / 2) : 0;
}

}  // namespace etendue::equations
