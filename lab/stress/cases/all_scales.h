// A closed emitting sphere with a radius from 0.1 mm to 1000 km.   [Kajiya 1986]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void all_scales(TestContext& test) {
  for (const float radius : {1e-4f, 1e-2f, 1.0f, 1e3f, 1e6f}) {
    scene::Scene scene;
    scene::add(scene, scene::sphere(radius, 32, true), scene::diffuse(Rgb(0.5f), Rgb(1)));
    const auto d =
        test.document(std::move(scene), look_at(radius * Vec3(0.2f, 0.1f, 0), radius * Vec3(0, 0, 1), {0, 1, 0}, 1));
    for (const auto& method : unbiased_integrators())
      test.expect_mean(method, "radius " + number(radius),
                       test.mean(TestContext::with_method(d, method + ":sampler=random"), 64), 2);
  }
}

inline constexpr Case kAllScales{
    .name = "all-scales",
    .kind = Kind::geometry,
    .theory =
        "The radiance inside a closed diffuse emitter, L_e / (1 - albedo), does not depend on its "
        "size, so the offsets of ray origins must scale with the scene",
    .run = all_scales};

}  // namespace etendue::stress
