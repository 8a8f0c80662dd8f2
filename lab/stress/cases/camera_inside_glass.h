// A camera at the centre of a glass sphere.   [Veach 1997, sec. 5.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void camera_inside_glass(TestContext& test) {
  for (const float ior : {1.2f, 1.5f}) {
    scene::Scene scene = uniform_sky();
    scene::add(scene, scene::sphere(1, 64, false), scene::glass(ior));
    const auto d = test.document(std::move(scene), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    for (const auto& method : unbiased_integrators())
      test.expect_mean(method, "index " + number(ior), test.mean(TestContext::with_method(d, method), 64),
                       double{ior} * ior);
  }
}

inline constexpr Case kCameraInsideGlass{
    .name = "camera-inside-glass",
    .kind = Kind::geometry,
    .theory =
        "Inside glass of index n a uniform sky has the radiance n^2, because refraction compresses "
        "solid angles by that factor",
    .run = camera_inside_glass};

}  // namespace etendue::stress
