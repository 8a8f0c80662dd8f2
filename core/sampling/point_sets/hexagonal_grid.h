// Hexagonal grids                                                                          [Lang, sec. 7.2]
//
// Each two-dimensional decision of a group takes the points of a hexagonal grid that is periodic in the unit square,
// moved by a random offset modulo 1 (Cranley-Patterson rotation). Rows are 0.87 of the distance of points apart, as far
// as whole numbers of rows permit, and every other row is displaced by half a distance.
//
//   Properties    The largest distance between nearest points that a set of this size can have.
//   Limitations   The projections onto the axes have few points. Periodic structures cause aliasing.
#pragma once
#include "sampling/point_group.h"

namespace etendue {

class HexagonalGridSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "hexagonal-grid",
      .label = "Hexagonal grid",
      .doc = "Hexagonal grids with a random offset: the largest distances between points. For comparison.",
      .progressive = false,
      .for_study = true,
      .joint_dimensions = 2,
      .padding = "independent orders of samples for each decision of a path",
  };
  Number<int> columns{
      "columns", "Points per row", 4, {1, 64}, "A group of samples has about 1.15 times the square of this number."};
  auto parameters() { return std::tie(columns); }

  // An even number of rows, so that the grid is periodic.
  static uint32_t rows(uint32_t columns) {
    constexpr double kInverseRootOfThree = 0.57735026918962576;
    return 2 * std::max(1U, static_cast<uint32_t>(std::lround(columns * kInverseRootOfThree)));
  }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const auto n = static_cast<uint32_t>(columns.value);
    const uint32_t m = rows(n);
    fill_from_group(group_member(pixel_seed, sample, block, n * m), n * m, out, [&](uint32_t i, uint32_t seed) {
      const uint32_t column = i % n, row = i / n;
      return std::array{rotated((column + 0.5 * (row % 2)) / n, seed), rotated(static_cast<double>(row) / m, ~seed)};
    });
  }
};

}  // namespace etendue
