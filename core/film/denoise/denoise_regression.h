// Weighted least squares for several neighbouring pixels at once
#pragma once
#include <array>

#include "film/denoise.h"

namespace etendue::film {

// Normal equations of kLanes pixels: unknowns are a constant and one slope per feature, for three channels. Features are
// relative to those of the centre pixel, so that the constant is the value of the fit there.
struct RegressionLanes {
  static constexpr size_t kLanes = 16;
  static constexpr size_t kUnknowns = kDenoiseFeatures + 1;
  static constexpr size_t kEntries = kUnknowns * (kUnknowns + 1) / 2;
  using Lanes = std::array<float, kLanes>;

  alignas(64) std::array<Lanes, kEntries> matrix{};  // lower triangle, row by row
  alignas(64) std::array<std::array<Lanes, kUnknowns>, 3> right{};

  // The fitted values at the centre of a pixel. Slopes are damped where the features hardly vary.
  Rgb solve(size_t lane) const;
};

}  // namespace etendue::film
