#include "film/denoise_regression.h"

#include <algorithm>
#include <cmath>

namespace etendue::film {
namespace {

// Added to the mean squared deviation of each feature (ridge regression). Features that vary by less than about 1e-3
// are noise or rounding errors, whose slopes would amplify the noise of the radiance.
constexpr double kRidge = 1e-6;

}  // namespace

// Cholesky decomposition. The unknowns are in the reverse order, with the constant last, so that the first unknown of
// the back substitution is the result.
Rgb RegressionLanes::solve(size_t lane) const {
  constexpr size_t n = kUnknowns;
  const double total = double{matrix[0][lane]};
  if (!(total > 0)) return Rgb(0);
  // Unknown i of this system is unknown n - 1 - i of the normal equations.
  const auto entry = [&](size_t i, size_t j) {
    const size_t row = n - 1 - std::min(i, j);
    const size_t column = n - 1 - std::max(i, j);
    return double{matrix[row * (row + 1) / 2 + column][lane]} / total;
  };
  std::array<std::array<double, n>, n> factor;
  std::array<std::array<double, n>, 3> forward;
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      double sum = entry(i, j);
      if (i == j && i + 1 < n) sum += kRidge;
      for (size_t k = 0; k < j; ++k) sum -= factor[i][k] * factor[j][k];
      factor[i][j] = i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / factor[j][j];
    }
    for (size_t c = 0; c < 3; ++c) {
      double sum = double{right[c][n - 1 - i][lane]} / total;
      for (size_t k = 0; k < i; ++k) sum -= factor[i][k] * forward[c][k];
      forward[c][i] = sum / factor[i][i];
    }
  }
  const auto value = [&](size_t c) { return static_cast<float>(forward[c][n - 1] / factor[n - 1][n - 1]); };
  return {value(0), value(1), value(2)};
}

}  // namespace etendue::film
