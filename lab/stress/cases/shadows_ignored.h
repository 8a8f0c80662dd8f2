// A plate between a point light and the floor.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void shadows_ignored(Lab& lab) {
  scene::Scene scene;
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0.5f)));
  Mat4 place(1);
  place[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::quad(0.8f), scene::diffuse(Rgb(0)), place);
  add_point_light(scene, {0, 2, 0}, 8);
  const auto d = lab.document(std::move(scene), telescope({2, 0.5f, 0}, {0, 0, 0}));
  lab.expect_near("raycast", "", lab.mean(Lab::with_method(d, "raycast"), 16).value, 0.5 / kPi * 8 / 4, 1e-3);
  lab.expect_zero("path", "", lab.mean(Lab::with_method(d, "path"), 16).value);
}

inline constexpr Case kShadowsIgnored{"shadows-ignored", Kind::bias,
                                      "Local illumination takes every light to be in sight: it shows light where there "
                                      "is none",
                                      shadows_ignored};

}  // namespace etendue::stress
