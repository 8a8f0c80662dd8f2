// A point light of 100 W, 2 m above a diffuse floor.   [Lang, sec. 9.1.1]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void point_light_unseen(TestContext& test) {
  scene::Scene scene;
  scene::add(scene, scene::quad(10), scene::diffuse(Rgb(0.5f)));
  add_point_light(scene, {0, 2, 0}, 100 / (4 * kPi));
  const auto d = test.document(std::move(scene), narrow_camera({1, 1, 0}, {0, 0, 0}));
  test.expect_zero("path-pure", "", test.mean(TestContext::with_method(d, "path-pure"), 16).value);
  test.expect_near("path", "", test.mean(TestContext::with_method(d, "path"), 16).value,
                   0.5 / kPi * 100 / (4 * kPi) / 4, 1e-3);
}

inline constexpr Case kPointLightUnseen{
    .name = "point-light-unseen",
    .kind = Kind::missing_paths,
    .theory =
        "BSDF sampling hits a point light with probability zero; light sampling always yields albedo "
        "/ pi I cos / r^2",
    .run = point_light_unseen};

}  // namespace etendue::stress
