#include "film/denoise/local_regression.h"

#include <algorithm>

#include "base/vectorize.h"

namespace etendue::film {
namespace {

constexpr size_t kLanes = kRegressionLanes;
constexpr size_t kUnknowns = kDenoiseFeatures + 1;
constexpr size_t kEntries = kUnknowns * (kUnknowns + 1) / 2;

// Added to the mean squared deviation of each feature (ridge regression). Features that vary by less than about 3e-3
// are noise or rounding errors, whose slopes would amplify the noise of the radiance.
constexpr float kRidge = 1e-5f;
constexpr float kMinPivot = 1e-7f;

// Normal equations. The unknowns are the slopes and then the constant, so that the first unknown of the back
// substitution is the result. Features and colours are relative to those of the centre pixel.
struct NormalEquations {
  alignas(64) std::array<RegressionLanes, kEntries> matrix{};  // lower triangle, row by row
  alignas(64) std::array<std::array<RegressionLanes, kUnknowns>, 3> right{};
};

// One neighbour of each pixel. The last of `terms` is the constant 1.
struct Neighbors {
  alignas(64) RegressionLanes weight;
  alignas(64) std::array<RegressionLanes, kUnknowns> terms;
  alignas(64) std::array<RegressionLanes, 3> color;
};

ETENDUE_VECTORIZE void subtract_center(const float* neighbor, const float* center, RegressionLanes& difference) {
  for (size_t i = 0; i < kLanes; ++i) difference[i] = neighbor[i] - center[i];
}

ETENDUE_VECTORIZE void add_neighbors(const Neighbors& n, NormalEquations& sums) {
  size_t entry = 0;
  for (size_t row = 0; row < kUnknowns; ++row) {
    alignas(64) RegressionLanes weighted;
    for (size_t i = 0; i < kLanes; ++i) weighted[i] = n.weight[i] * n.terms[row][i];
    for (size_t column = 0; column <= row; ++column, ++entry)
      for (size_t i = 0; i < kLanes; ++i) sums.matrix[entry][i] += weighted[i] * n.terms[column][i];
    for (size_t c = 0; c < 3; ++c)
      for (size_t i = 0; i < kLanes; ++i) sums.right[c][row][i] += weighted[i] * n.color[c][i];
  }
}

ETENDUE_VECTORIZE void raise_to_fourth_power(RegressionLanes& weight) {
  for (size_t i = 0; i < kLanes; ++i) weight[i] = weight[i] * weight[i] * (weight[i] * weight[i]);
}

// Cholesky decomposition L D L^T and substitution, which overwrite the equations. The solution is relative to the
// centre.
ETENDUE_VECTORIZE void solve(NormalEquations& e, std::array<RegressionLanes, 3>& solution) {
  constexpr size_t n = kUnknowns;
  alignas(64) RegressionLanes scale;
  for (size_t i = 0; i < kLanes; ++i) {
    const float total = e.matrix[kEntries - 1][i];
    scale[i] = total > 0 ? 1 / total : 0;
  }
  for (auto& entry : e.matrix)
    for (size_t i = 0; i < kLanes; ++i) entry[i] *= scale[i];
  for (auto& channel : e.right)
    for (auto& entry : channel)
      for (size_t i = 0; i < kLanes; ++i) entry[i] *= scale[i];
  for (size_t k = 0; k < n; ++k) {
    RegressionLanes& pivot = e.matrix[k * (k + 1) / 2 + k];
    const float ridge = k + 1 < n ? kRidge : 0;
    alignas(64) RegressionLanes inverse;
    for (size_t i = 0; i < kLanes; ++i) {
      const float p = pivot[i] + ridge;
      inverse[i] = 1 / (p > kMinPivot ? p : kMinPivot);
    }
    for (size_t row = k + 1; row < n; ++row) {
      const RegressionLanes& below = e.matrix[row * (row + 1) / 2 + k];
      alignas(64) RegressionLanes factor;
      for (size_t i = 0; i < kLanes; ++i) factor[i] = below[i] * inverse[i];
      for (size_t column = k + 1; column <= row; ++column) {
        const RegressionLanes& other = e.matrix[column * (column + 1) / 2 + k];
        RegressionLanes& entry = e.matrix[row * (row + 1) / 2 + column];
        for (size_t i = 0; i < kLanes; ++i) entry[i] -= factor[i] * other[i];
      }
      for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < kLanes; ++i) e.right[c][row][i] -= factor[i] * e.right[c][k][i];
    }
    if (k + 1 == n)
      for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < kLanes; ++i) solution[c][i] = e.right[c][k][i] * inverse[i];
  }
}

}  // namespace

void fit_windows(const RegressionPlanes& planes, int x, int y, const float* weights, RegressionResult& result) {
  std::array<NormalEquations, kBandwidths> sums{};
  Neighbors neighbors;
  neighbors.terms.back().fill(1);
  for (int dy = -kRegressionRadius; dy <= kRegressionRadius; ++dy)
    for (int dx = -kRegressionRadius; dx <= kRegressionRadius; ++dx, weights += kTilePixels) {
      for (size_t i = 0; i < kLanes; ++i) neighbors.weight[i] = weights[i];
      for (size_t k = 0; k < kDenoiseFeatures; ++k)
        subtract_center(planes.features[k].at(x + dx, y + dy), planes.features[k].at(x, y), neighbors.terms[k]);
      for (size_t c = 0; c < 3; ++c)
        subtract_center(planes.colors[c].at(x + dx, y + dy), planes.colors[c].at(x, y), neighbors.color[c]);
      add_neighbors(neighbors, sums[0]);
      raise_to_fourth_power(neighbors.weight);
      add_neighbors(neighbors, sums[1]);
    }
  for (size_t b = 0; b < kBandwidths; ++b) {
    solve(sums[b], result[b]);
    for (size_t c = 0; c < 3; ++c)
      for (size_t i = 0; i < kLanes; ++i)
        result[b][c][i] = std::max(result[b][c][i] + planes.colors[c].at(x, y)[i], 0.0f);
  }
}

}  // namespace etendue::film
