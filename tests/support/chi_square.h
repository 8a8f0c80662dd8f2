// Chi-square test of sampled directions against a density per solid angle.
#pragma once
#include <functional>

#include "base/vec.h"

namespace etendue::test {

struct ChiSquare {
  double statistic = 0, p_value = 1;
  int degrees = 0;
};

// `sample` returns a direction or false. False means absorption, which is counted in a cell of its own; its expectation
// is what the density lacks to one. A density that integrates to more than one therefore shows in this cell. A pilot
// run of a fifth as many samples determines where cells are small. Cells with an expectation below five are pooled.
ChiSquare chi_square_on_sphere(const std::function<bool(Vec3&)>& sample, const std::function<double(const Vec3&)>& pdf,
                               int samples);

}  // namespace etendue::test
