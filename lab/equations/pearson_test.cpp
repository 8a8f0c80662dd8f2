#include "equations/pearson_test.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

namespace etendue::equations {

ChiSquareTest chi_square_test(std::span<const double> counts, std::span<const double> expected) {
  constexpr double kSmallestExpectation = 5;
  ChiSquareTest test;
  double pooled_count = 0, pooled_expectation = 0;
  int cells = 0;
  const auto add = [&](double count, double expectation) {
    test.statistic += (count - expectation) * (count - expectation) / expectation;
    ++cells;
  };
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] >= kSmallestExpectation) {
      add(counts[i], expected[i]);
    } else {
      pooled_count += counts[i];
      pooled_expectation += expected[i];
    }
  }
  // Counts in cells that the density does not reach are impossible.
  if (pooled_expectation > 0)
    add(pooled_count, pooled_expectation);
  else if (pooled_count > 0)
    test.statistic = INFINITY;
  test.degrees = std::max(1, cells - 1);
  test.p_value = chi_square_survival(test.statistic, test.degrees);
  return test;
}

double chi_square_survival(double statistic, int degrees) {
  return std::isfinite(statistic) ? Eigen::numext::igammac(degrees / 2.0, statistic / 2) : 0;
}

}  // namespace etendue::equations
