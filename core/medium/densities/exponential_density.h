// A density that falls exponentially with height, as that of an isothermal atmosphere (the barometric formula).
#pragma once
#include "base/result.h"
#include "medium/densities/sampled_density.h"
#include "medium/density_info.h"

namespace etendue {

struct ExponentialDensity {
  static constexpr DensityDescription kDescription{
      .name = "exponential",
      .label = "Exponential in height",
      .summary = "Falls exponentially with height above a base, as haze above the ground.",
      .formula = "density = exp(-max(h - base, 0) / scale-height), h = (y + 1) / 2",
      .limitations =
          "Heights are fractions of the height of the bounding box. The density is linear between 257 nodes.",
  };

  Number<float> base{
      "base", "Base", 0, {0, 1}, "Height below which the density is 1, as a fraction of the height of the box"};
  Number<float> scale_height{"scale-height",
                             "Scale height",
                             0.2f,
                             {1e-3f, 100},
                             "Height over which the density falls to 37 %, as a fraction of the height of the box",
                             "",
                             Scale::logarithmic};

  auto parameters() { return std::tie(base, scale_height); }

  Result<GridValues> values() const {
    constexpr int kNodes = 257;
    return sampled_density({2, kNodes, 2}, [&](const Vec3& p) {
      return std::exp(-std::max(0.5f * (p.y + 1) - base, 0.0f) / scale_height);
    });
  }
};

}  // namespace etendue
