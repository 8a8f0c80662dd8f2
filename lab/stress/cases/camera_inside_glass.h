// The camera in the middle of a ball of glass.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void camera_inside_glass(Lab& lab) {
  for (const float ior : {1.2f, 1.5f}) {
    scene::Scene scene = sky();
    scene::add(scene, scene::sphere(1, 64, false), scene::glass(ior));
    const auto d = lab.document(std::move(scene), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    for (const auto& method : unbiased_methods())
      lab.expect_mean(method, "index " + number(ior), lab.mean(Lab::with_method(d, method), 64), double{ior} * ior);
  }
}

inline constexpr Case kCameraInsideGlass{
    "camera-inside-glass", Kind::geometry,
    "Inside glass of index n a uniform sky has the radiance n^2: what refraction compresses, it must not lose",
    camera_inside_glass};

}  // namespace etendue::stress
