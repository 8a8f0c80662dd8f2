// A point light of 100 W, 2 m over a Lambertian floor.                                                  digest 8-10: F1
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void point_light_unseen(Lab& lab) {
  scene::Scene scene;
  scene::add(scene, scene::quad(10), scene::diffuse(Rgb(0.5f)));
  add_point_light(scene, {0, 2, 0}, 100 / (4 * kPi));
  const auto d = lab.document(std::move(scene), telescope({1, 1, 0}, {0, 0, 0}));
  lab.expect_zero("path-pure", "", lab.mean(Lab::with_method(d, "path-pure"), 16).value);
  lab.expect_near("path", "", lab.mean(Lab::with_method(d, "path"), 16).value, 0.5 / kPi * 100 / (4 * kPi) / 4, 1e-3);
}

inline constexpr Case kPointLightUnseen{
    "point-light-unseen", Kind::missing_paths,
    "A walk meets a point with probability zero; a connection finds it always, with rho/pi I/r^2", point_light_unseen};

}  // namespace etendue::stress
