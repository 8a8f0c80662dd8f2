// A clear sphere under a uniform sky, with an index from nearly one to that of diamond.   [Lang, sec. 4.2.1.3]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void lossless_glass(TestContext& test) {
  for (const float ior : {1.001f, 1.33f, 1.5f, 2.4f}) {
    scene::Scene scene = uniform_sky();
    scene::add(scene, scene::sphere(1, 48, false), scene::glass(ior));
    const auto d = test.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.3f));
    for (const auto& method : unbiased_integrators())
      test.expect_mean(method, "index " + number(ior), test.mean(TestContext::with_method(d, method), 64), 1);
  }
}

inline constexpr Case kLosslessGlass{
    .name = "lossless-glass",
    .kind = Kind::parameters,
    .theory =
        "A clear sphere reflects and refracts a uniform sky without loss, so its radiance is one for "
        "every index",
    .run = lossless_glass};

}  // namespace etendue::stress
