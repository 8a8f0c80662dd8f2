#include "integrator/guiding/cosine_product.h"

#include "base/vectorize.h"

namespace etendue::guiding {
namespace {

// Cells whose centre lies slightly below the horizon contain directions above it.
constexpr float kMargin = 0.35f;

using Directions = Vec3Lanes<kCells>;

const Directions& centres_of_cells() {
  static const Directions centres = [] {
    constexpr float kHalfCell = 0.5f / (1 << kCellDepth);
    Directions directions;
    for (size_t i = 0; i < kCells; ++i) directions.set(i, square_to_sphere(cell_corner(i) + kHalfCell));
    return directions;
  }();
  return centres;
}

// Writes the cosines of the cells, and returns their mean with the weights `probabilities`. `opposite` is the weight of
// directions on the other side of the surface.
ETENDUE_VECTORIZE
float compute_cosines(const Directions& directions, const float* probabilities, Vec3 normal, float opposite,
                      float* cosines) {
  alignas(64) std::array<float, kMaxLanes> sums{};
  for (size_t first = 0; first < kCells; first += kMaxLanes)
    for (size_t lane = 0; lane < kMaxLanes; ++lane) {
      const size_t i = first + lane;
      const float cosine = directions.x[i] * normal.x + directions.y[i] * normal.y + directions.z[i] * normal.z;
      cosines[i] = std::max(std::max(cosine + kMargin, 0.0f), opposite * (kMargin - cosine));
      sums[lane] += cosines[i] * probabilities[i];
    }
  for (size_t half = kMaxLanes / 2; half > 0; half /= 2)
    for (size_t lane = 0; lane < half; ++lane) sums[lane] += sums[lane + half];
  return sums[0];
}

// Sums of four neighbours each.
template <size_t N>
std::array<float, N / 4> sums_of_quarters(const std::array<float, N>& values) {
  std::array<float, N / 4> sums;
  for (size_t i = 0; i < N / 4; ++i)
    sums[i] = (values[4 * i] + values[4 * i + 1]) + (values[4 * i + 2] + values[4 * i + 3]);
  return sums;
}

}  // namespace

void CosineProduct::set(const DirectionalDistribution& distribution, const Vec3& normal, ScatteredSide side) {
  distribution_ = &distribution;
  inverse_total_ = 1 / compute_cosines(centres_of_cells(), distribution.cell_probabilities().data(), normal,
                                       side == ScatteredSide::both ? 1.0f : 0.0f, cosines_.data());
}

Vec2 CosineProduct::sample(Vec2 u) const {
  std::array<float, kCells> masses;
  for (size_t i = 0; i < kCells; ++i) masses[i] = cosines_[i] * distribution_->cell_probabilities()[i];
  const auto coarse = sums_of_quarters(masses);
  size_t cell = select_quarter(coarse.data(), u);
  cell = 4 * cell + select_quarter(&masses[4 * cell], u);
  return distribution_->sample_in_cell(cell, u);
}

}  // namespace etendue::guiding
