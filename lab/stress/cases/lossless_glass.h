// A clear ball under a uniform sky, from barely refracting to diamond.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void lossless_glass(Lab& lab) {
  for (const float ior : {1.001f, 1.33f, 1.5f, 2.4f}) {
    scene::Scene scene = sky();
    scene::add(scene, scene::sphere(1, 48, false), scene::glass(ior));
    const auto d = lab.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.3f));
    for (const auto& method : unbiased_methods())
      lab.expect_mean(method, "index " + number(ior), lab.mean(Lab::with_method(d, method), 64), 1);
  }
}

inline constexpr Case kLosslessGlass{"lossless-glass", Kind::parameters,
                                     "A clear ball under a uniform sky reflects and refracts without loss: radiance is "
                                     "one whatever the index or the roughness of zero",
                                     lossless_glass};

}  // namespace etendue::stress
