// A ball whose density falls smoothly to 0 at its surface.
#pragma once
#include "base/result.h"
#include "medium/densities/sampled_density.h"
#include "medium/density_info.h"

namespace etendue {

struct BallDensity {
  static constexpr DensityDescription kDescription{
      .name = "ball",
      .label = "Ball",
      .summary = "A ball, or an ellipsoid in an oblong box, whose density falls smoothly to 0 at its surface.",
      .formula = "density = (1 - r^2)^exponent for r < 1, else 0; r^2 = x^2 + y^2 + z^2",
      .limitations = "Linear between the nodes of the grid.",
  };

  Number<float> exponent{"exponent", "Exponent", 2, {0.5f, 20}, "Higher concentrates the density near the centre"};
  Number<int> resolution{
      "resolution", "Resolution", 64, {4, 256}, "Voxels along each axis: higher is smoother and takes more memory"};

  auto parameters() { return std::tie(exponent, resolution); }

  Result<GridValues> values() const {
    const int nodes = resolution + 1;
    return sampled_density({nodes, nodes, nodes},
                           [&](const Vec3& p) { return std::pow(std::max(1 - glm::dot(p, p), 0.0f), exponent.value); });
  }
};

}  // namespace etendue
