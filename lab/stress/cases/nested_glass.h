// Glass solids inside each other, and side by side without a gap, in front of an emitting plate.
//                                                                                     [Schmidt and Budge 2002]
#pragma once
#include <cmath>
#include <vector>

#include "stress/case.h"

namespace etendue::stress {

// The transmittance of parallel clear layers at normal incidence, with all reflections between them. `indices` are the
// indices of refraction of the media in order.
inline double layers_transmission(const std::vector<double>& indices) {
  double ratio = 0;  // of reflected to transmitted light; the ratios of the boundaries add up
  for (size_t i = 1; i < indices.size(); ++i) {
    const double r = std::pow((indices[i - 1] - indices[i]) / (indices[i - 1] + indices[i]), 2);
    ratio += r / (1 - r);
  }
  return 1 / (1 + ratio);
}

// Adds a plate of radiance one that faces up, `depth` metres below the origin.
inline void add_plate(scene::Scene& scene, float depth) {
  Mat4 place(1);
  place[3] = Vec4(0, -depth, 0, 1);
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(1)), place);
}

inline void nested_glass(TestContext& test) {
  constexpr double kWater = 1.33, kDense = 1.8;
  const auto solid = [](double index) { return scene::glass(static_cast<float>(index)); };
  scene::Scene nested;
  scene::add(nested, scene::cube(1, false), solid(kWater));
  scene::add(nested, scene::cube(0.6f, false), solid(kDense));
  scene::Scene touching;
  for (const float y : {-1.0f, 1.0f}) {
    Mat4 place(1);
    place[3] = Vec4(0, y, 0, 1);
    scene::add(touching, scene::cube(1, false), solid(y < 0 ? kWater : kDense), place);
  }
  scene::Scene same;
  scene::add(same, scene::cube(1, false), solid(kDense));
  scene::add(same, scene::cube(0.6f, false), solid(kDense));
  const struct {
    const char* point;
    scene::Scene& scene;
    std::vector<double> indices;
  } arrangements[] = {{"nested", nested, {1, kWater, kDense, kWater, 1}},
                      {"touching", touching, {1, kDense, kWater, 1}},
                      {"equal media", same, {1, kDense, 1}}};
  const Camera camera = look_at({0.013f, 4, 0.017f}, {0.013f, 0, 0.017f}, {0, 0, 1}, 1e-4f);
  for (const auto& [point, scene, indices] : arrangements) {
    add_plate(scene, 3);
    const auto d = test.document(scene, camera);
    for (const auto& method : unbiased_integrators())
      test.expect_mean(method, point, test.mean(TestContext::with_method(d, method), 256),
                       layers_transmission(indices));
  }
}

inline constexpr Case kNestedGlass{
    .name = "nested-glass",
    .kind = Kind::geometry,
    .theory =
        "The boundary between nested or touching solids reflects (n1 - n2)^2 / (n1 + n2)^2 at normal "
        "incidence; between equal media it has no effect",
    .run = nested_glass};

}  // namespace etendue::stress
