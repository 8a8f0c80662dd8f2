// The same density everywhere in the bounding box.
#pragma once
#include "base/result.h"
#include "medium/densities/sampled_density.h"
#include "medium/density_info.h"

namespace etendue {

struct ConstantDensity {
  static constexpr DensityDescription kDescription{
      .name = "constant",
      .label = "Constant",
      .summary = "The same density everywhere; for comparison with the homogeneous medium, which it equals.",
      .formula = "density = value",
      .limitations = "A homogeneous medium renders faster.",
  };

  Number<float> value{"value", "Density", 1, {0, 1000}, "Factor on the coefficients of the medium"};

  auto parameters() { return std::tie(value); }

  Result<GridValues> values() const {
    return sampled_density({2, 2, 2}, [&](const Vec3&) { return value.value; });
  }
};

}  // namespace etendue
