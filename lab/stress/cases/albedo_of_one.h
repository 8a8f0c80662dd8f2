// A white sphere and a white floor under a uniform sky.   [Arvo and Kirk 1990]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void albedo_of_one(TestContext& test) {
  scene::Scene scene = uniform_sky();
  scene::add(scene, scene::sphere(1, 48, false), scene::diffuse(Rgb(1)));
  Mat4 transform(1);
  transform[3] = Vec4(0, -1, 0, 1);
  scene::add(scene, scene::quad(2), scene::diffuse(Rgb(1)), transform);
  const auto d = test.document(std::move(scene), look_at({0, 1, 4}, {0, -0.5f, 0}, {0, 1, 0}, 0.5f));
  for (const auto& method : unbiased_integrators())
    test.expect_mean(method, "", test.mean(TestContext::with_method(d, method), 64), 1);
}

inline constexpr Case kAlbedoOfOne{
    .name = "albedo-of-one",
    .kind = Kind::parameters,
    .theory =
        "A surface that absorbs nothing has the radiance of the uniform sky around it, and paths on "
        "it terminate",
    .run = albedo_of_one};

}  // namespace etendue::stress
