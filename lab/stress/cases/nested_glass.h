// Solids of glass in each other, and side by side without a gap.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void nested_glass(Lab& lab) {
  scene::Scene nested = sky();
  scene::add(nested, scene::sphere(1, 48, false), scene::glass(1.33f));
  scene::add(nested, scene::sphere(0.6f, 48, false), scene::glass(1.8f));
  scene::Scene touching = sky();
  for (const float x : {-1.0f, 1.0f}) {
    Mat4 place(1);
    place[3] = Vec4(x, 0, 0, 1);
    scene::add(touching, scene::cube(1, false), scene::glass(1.5f), place);
  }
  const Camera camera = look_at({1, 2, 6}, {0, 0, 0}, {0, 1, 0}, 0.2f);
  for (const auto& [point, scene] : {std::pair{"one in the other", nested}, {"face to face", touching}}) {
    const auto d = lab.document(scene, camera);
    for (const auto& method : unbiased_methods())
      lab.expect_mean(method, point, lab.mean(Lab::with_method(d, method), 128), 1);
  }
}

inline constexpr Case kNestedGlass{"nested-glass", Kind::geometry,
                                   "However clear solids stand to each other, none of a uniform sky is lost: every "
                                   "surface that is entered is left, even where two lie in one plane",
                                   nested_glass};

}  // namespace etendue::stress
