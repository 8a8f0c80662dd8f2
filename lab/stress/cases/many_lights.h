// A ring of point lights over a floor.                                                             digest 8-10: F22, E3
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void many_lights(Lab& lab) {
  for (const int count : {1, 4, 64}) {
    scene::Scene scene;
    scene::add(scene, scene::quad(10), scene::diffuse(Rgb(0.5f)));
    for (int i = 0; i < count; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(count);
      add_point_light(scene, {std::cos(angle), 2, std::sin(angle)}, 8);
    }
    const auto d = lab.document(std::move(scene), telescope({1, 1, 0}, {0, 0, 0}));
    // rho/pi I cos / r^2 of each
    const double expected = count * 0.5 / kPi * 8 * (2 / std::sqrt(5.0)) / 5;
    for (const char* method :
         {"raycast", "appel", "appel:lights=one", "whitted", "distribution", "distribution:lights=every", "path"})
      lab.expect_near(method, std::to_string(count) + " lights", lab.mean(Lab::with_method(d, method), 16).value,
                      expected, 1e-3);
  }
}

inline constexpr Case kManyLights{"many-lights", Kind::bias,
                                  "Lights add up: their mean, which the thesis prints, would be as many times too dark",
                                  many_lights};

}  // namespace etendue::stress
