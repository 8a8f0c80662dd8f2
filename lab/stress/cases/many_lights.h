// A ring of point lights above a floor.   [Lang, eq. 8.19, corrected; Appel 1968]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void many_lights(TestContext& test) {
  for (const int count : {1, 4, 64}) {
    scene::Scene scene;
    scene::add(scene, scene::quad(10), scene::diffuse(Rgb(0.5f)));
    for (int i = 0; i < count; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(count);
      add_point_light(scene, {std::cos(angle), 2, std::sin(angle)}, 8);
    }
    const auto d = test.document(std::move(scene), narrow_camera({1, 1, 0}, {0, 0, 0}));
    // The sum of albedo / pi I cos / r^2 over the lights.
    const double expected = count * 0.5 / kPi * 8 * (2 / std::sqrt(5.0)) / 5;
    for (const char* method :
         {"raycast", "appel", "appel:lights=one", "whitted", "distribution", "distribution:lights=every", "path"})
      test.expect_near(method, std::to_string(count) + " lights",
                       test.mean(TestContext::with_method(d, method), 16).value, expected, 1e-3);
  }
}

inline constexpr Case kManyLights{
    .name = "many-lights",
    .kind = Kind::bias,
    .theory =
        "The contributions of all lights add up; their mean would be too dark by a factor equal to "
        "the number of lights",
    .run = many_lights};

}  // namespace etendue::stress
