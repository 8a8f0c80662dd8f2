// Pearson's chi-square test of counts against their expectations.
#pragma once
#include <span>

namespace etendue::equations {

struct ChiSquareTest {
  double statistic = 0;
  int degrees = 0;     // of freedom
  double p_value = 1;  // probability of a statistic at least as large if the expectations are right
};

// Cells with an expectation below five are counted together; together with the smallest other cell if that is still too
// few.
ChiSquareTest chi_square_test(std::span<const double> counts, std::span<const double> expected);

// The survival function of the chi-square distribution.
double chi_square_survival(double statistic, int degrees);

}  // namespace etendue::equations
