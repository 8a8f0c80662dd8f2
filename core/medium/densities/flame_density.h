// A fire: a column of hot gas whose width and edge are disturbed by fractal noise, with its temperature.
#pragma once
#include "base/result.h"
#include "medium/densities/gradient_noise.h"
#include "medium/densities/sampled_density.h"
#include "medium/density_info.h"

namespace etendue {

struct FlameDensity {
  static constexpr DensityDescription kDescription{
      .name = "flame",
      .label = "Flame",
      .summary = "A column of hot gas that narrows upwards, disturbed by fractal noise; hottest inside and below.",
      .formula =
          "density = clamp(4 s, 0, 1), temperature = clamp(1.6 s, 0, 1) (1 - 0.45 h); s: 1 at the axis, 0 outside",
      .limitations = "A picture of a fire, not a simulation of combustion. Linear between the nodes of the grid.",
      .source = "[Perlin 2002]",
  };

  Number<float> turbulence{"turbulence", "Turbulence", 0.45f, {0, 2}, "Higher disturbs the edge of the flame more"};
  Number<float> frequency{"frequency", "Frequency", 2, {0.1f, 50}, "Higher makes smaller tongues"};
  Number<int> seed{"seed", "Seed", 3, {0, 1000000}, "Selects one of many flames"};
  Number<int> resolution{
      "resolution", "Resolution", 96, {4, 256}, "Voxels along each axis: higher is finer and takes more memory"};

  auto parameters() { return std::tie(turbulence, frequency, seed, resolution); }

  Result<GridValues> values() const {
    const int nodes = resolution + 1;
    GridValues values{{nodes, nodes, nodes}, {}, {}};
    values.density.resize(node_count(values.nodes));
    values.temperature.resize(node_count(values.nodes));
    for_each_node(values.nodes, [&](const Vec3& p, size_t i) {
      const float s = strength(p), height = 0.5f * (p.y + 1);
      values.density[i] = std::clamp(4 * s, 0.0f, 1.0f);
      values.temperature[i] = std::clamp(1.6f * s, 0.0f, 1.0f) * (1 - 0.45f * height);
    });
    return values;
  }

 private:
  // 1 at the axis, falling to 0 at the edge and below 0 outside.
  float strength(const Vec3& p) const {
    const float height = 0.5f * (p.y + 1);  // from 0 to 1
    const Vec3 stretched(p.x * frequency, p.y * frequency * 0.6f, p.z * frequency);
    const auto number = static_cast<uint32_t>(seed.value);
    const Vec3 bend = Vec3(gradient_noise(stretched, number), 0, gradient_noise(stretched, number + 1)) * height;
    const Vec3 q = p + 0.5f * turbulence * bend;
    constexpr float kWidth = 0.55f;
    const float width = kWidth * std::sqrt(std::max(1 - height, 0.0f)) * std::min(1.0f, 0.6f + 4 * height);
    const float r = std::sqrt(q.x * q.x + q.z * q.z) / std::max(width, 1e-3f);
    const float edge = 1 - r + turbulence * fractal_noise(2.0f * stretched, 4, number + 2) * (0.4f + height);
    const float margin = 12 * (1 - max_component(glm::abs(p)));
    return std::min(edge, margin);
  }
};

}  // namespace etendue
