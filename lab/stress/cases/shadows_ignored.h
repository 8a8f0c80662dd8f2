// A plate between a point light and the floor.   [Appel 1968; Lang, sec. 8.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void shadows_ignored(TestContext& test) {
  scene::Scene scene;
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0.5f)));
  Mat4 transform(1);
  transform[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::quad(0.8f), scene::diffuse(Rgb(0)), transform);
  add_point_light(scene, {0, 2, 0}, 8);
  const auto d = test.document(std::move(scene), narrow_camera({2, 0.5f, 0}, {0, 0, 0}));
  test.expect_near("raycast", "", test.mean(TestContext::with_method(d, "raycast"), 16).value, 0.5 / kPi * 8 / 4, 1e-3);
  test.expect_zero("path", "", test.mean(TestContext::with_method(d, "path"), 16).value);
}

inline constexpr Case kShadowsIgnored{
    .name = "shadows-ignored",
    .kind = Kind::bias,
    .theory = "Ray casting with local illumination treats every light as visible and shows light in shadows",
    .run = shadows_ignored};

}  // namespace etendue::stress
