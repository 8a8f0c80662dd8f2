// A density that changes linearly from the bottom of the bounding box to its top.
#pragma once
#include "base/result.h"
#include "medium/densities/sampled_density.h"
#include "medium/density_info.h"

namespace etendue {

struct LinearDensity {
  static constexpr DensityDescription kDescription{
      .name = "linear",
      .label = "Linear in height",
      .summary = "Changes linearly from the bottom of the bounding box to its top.",
      .formula = "density = bottom + (top - bottom) (y + 1) / 2",
      .limitations = "",
  };

  Number<float> bottom{"bottom", "Density at the bottom", 1, {0, 1000}, "Factor on the coefficients at the bottom"};
  Number<float> top{"top", "Density at the top", 0, {0, 1000}, "Factor on the coefficients at the top"};

  auto parameters() { return std::tie(bottom, top); }

  // Two nodes along an axis suffice for a linear function; more of them give the majorants of more cells.
  Result<GridValues> values() const {
    constexpr int kNodes = 33;
    return sampled_density({2, kNodes, 2}, [&](const Vec3& p) { return bottom + (top - bottom) * (0.5f * (p.y + 1)); });
  }
};

}  // namespace etendue
