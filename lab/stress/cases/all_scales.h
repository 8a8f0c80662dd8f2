// A glowing ball from a tenth of a millimetre to a thousand kilometres.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void all_scales(Lab& lab) {
  for (const float radius : {1e-4f, 1e-2f, 1.0f, 1e3f, 1e6f}) {
    scene::Scene scene;
    scene::add(scene, scene::sphere(radius, 32, true), scene::diffuse(Rgb(0.5f), Rgb(1)));
    const auto d =
        lab.document(std::move(scene), look_at(radius * Vec3(0.2f, 0.1f, 0), radius * Vec3(0, 0, 1), {0, 1, 0}, 1));
    for (const auto& method : unbiased_methods())
      lab.expect_mean(method, "radius " + number(radius), lab.mean(Lab::with_method(d, method + ":sampler=random"), 64),
                      2);
  }
}

inline constexpr Case kAllScales{"all-scales", Kind::geometry,
                                 "Radiance inside a glowing ball, C / (1 - rho), does not depend on its size: offsets "
                                 "that keep rays off surfaces must scale",
                                 all_scales};

}  // namespace etendue::stress
