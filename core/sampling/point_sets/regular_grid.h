// Regular grids                                                                            [Lang, sec. 7.2]
//
// Each two-dimensional decision of a group of n x n samples takes the points of a regular grid, moved by a random
// offset modulo 1 (Cranley-Patterson rotation). For fixed-size sets see sampling/point_group.h.
//
//   Properties    The simplest set that fills the square evenly.
//   Limitations   The projections onto one axis have only n points. Periodic structures cause aliasing.
#pragma once
#include "sampling/point_group.h"

namespace etendue {

class RegularGridSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "regular-grid",
      .label = "Regular grid",
      .doc = "Grids with a random offset. For comparison: edges and periodic structures cause aliasing.",
      .progressive = false,
      .for_study = true,
      .joint_dimensions = 2,
      .padding = "independent orders of samples for each decision of a path",
  };
  Number<int> side{"side", "Points per side", 4, {1, 64}, "A group of samples has the square of this number."};
  auto parameters() { return std::tie(side); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const auto n = static_cast<uint32_t>(side.value);
    fill_from_group(group_member(pixel_seed, sample, block, n * n), n * n, out, [&](uint32_t i, uint32_t seed) {
      return std::array{rotated(static_cast<double>(i % n) / n, seed), rotated(static_cast<double>(i / n) / n, ~seed)};
    });
  }
};

}  // namespace etendue
