// A cumulus cloud: an ellipsoid whose surface is displaced by fractal noise.                            [Perlin 2002]
#pragma once
#include "base/result.h"
#include "medium/densities/gradient_noise.h"
#include "medium/densities/sampled_density.h"
#include "medium/density_info.h"

namespace etendue {

struct CloudDensity {
  static constexpr DensityDescription kDescription{
      .name = "cloud",
      .label = "Cloud",
      .summary = "An ellipsoid with a flat base whose surface is displaced by fractal noise.",
      .formula = "density = clamp(sharpness (1 - r + amplitude n(frequency p)), 0, 1), n: fractal gradient noise",
      .limitations = "Linear between the nodes of the grid. The noise is stretched with the bounding box.",
      .source = "[Perlin 2002]",
  };

  Number<float> frequency{"frequency", "Frequency", 1.9f, {0.1f, 50}, "Higher makes smaller billows"};
  Number<float> amplitude{"amplitude", "Amplitude", 0.7f, {0, 4}, "Higher displaces the surface further"};
  Number<int> octaves{"octaves", "Octaves", 5, {1, 8}, "Higher adds finer detail"};
  Number<float> sharpness{"sharpness", "Sharpness", 5, {0.1f, 100}, "Higher makes the edge of the cloud sharper"};
  Number<int> seed{"seed", "Seed", 1, {0, 1000000}, "Selects one of many clouds"};
  Number<int> resolution{
      "resolution", "Resolution", 96, {4, 256}, "Voxels along each axis: higher is finer and takes more memory"};

  auto parameters() { return std::tie(frequency, amplitude, octaves, sharpness, seed, resolution); }

  Result<GridValues> values() const {
    const int nodes = resolution + 1;
    return sampled_density({nodes, nodes, nodes}, [&](const Vec3& p) {
      constexpr float kHalfSize = 0.7f;  // of the ellipsoid, so that billows stay inside the box
      constexpr float kBase = -0.45f;    // height of the flat base
      const float r = std::sqrt(glm::dot(p, p)) / kHalfSize;
      const float noise = fractal_noise(p * frequency.value, octaves, static_cast<uint32_t>(seed.value));
      const float inside = std::min(1 - r + amplitude * noise, 6 * (p.y - kBase + 0.15f * noise));
      // Reaches 0 at the sides of the box.
      const float margin = 12 * (1 - max_component(glm::abs(p)));
      return std::clamp(sharpness * std::min(inside, margin), 0.0f, 1.0f);
    });
  }
};

}  // namespace etendue
