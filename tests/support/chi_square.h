// Chi-square of sampled directions against a density per solid angle.
#pragma once
#include <functional>

#include "base/vec.h"

namespace etendue::test {

struct ChiSquare {
  double statistic = 0, p_value = 1;
  int degrees = 0;
};

// `sample` gives a direction or false (absorbed: counted as a cell of its own, with what the density lacks to one).
// Cells are small where a fifth as many samples before these say so; those with an expectation under five are pooled.
// A density that adds to more than one shows in the cell of what is absorbed.
ChiSquare chi_square_on_sphere(const std::function<bool(Vec3&)>& sample, const std::function<double(const Vec3&)>& pdf,
                               int samples);

// Survival function of the chi-square distribution.
double chi_square_tail(double statistic, int degrees);

}  // namespace etendue::test
