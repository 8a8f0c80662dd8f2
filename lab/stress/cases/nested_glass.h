// Glass solids inside each other, and side by side without a gap.   [Schmidt and Budge 2002]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void nested_glass(TestContext& test) {
  scene::Scene nested = uniform_sky();
  scene::add(nested, scene::sphere(1, 48, false), scene::glass(1.33f));
  scene::add(nested, scene::sphere(0.6f, 48, false), scene::glass(1.8f));
  scene::Scene touching = uniform_sky();
  for (const float x : {-1.0f, 1.0f}) {
    Mat4 transform(1);
    transform[3] = Vec4(x, 0, 0, 1);
    scene::add(touching, scene::cube(1, false), scene::glass(1.5f), transform);
  }
  const Camera camera = look_at({1, 2, 6}, {0, 0, 0}, {0, 1, 0}, 0.2f);
  for (const auto& [point, scene] : {std::pair{"nested", nested}, {"adjacent", touching}}) {
    const auto d = test.document(scene, camera);
    for (const auto& method : unbiased_integrators())
      test.expect_mean(method, point, test.mean(TestContext::with_method(d, method), 128), 1);
  }
}

inline constexpr Case kNestedGlass{
    .name = "nested-glass",
    .kind = Kind::geometry,
    .theory =
        "Clear solids lose nothing of a uniform sky however they are nested: every boundary that is "
        "entered is left, even where two faces coincide",
    .run = nested_glass};

}  // namespace etendue::stress
