// A furnace whose walls are there twice.                                                               digest 8-10: F19
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void coincident_lights(Lab& lab) {
  scene::Scene scene = scene::furnace(0.5f);
  scene::add(scene, scene::cube(1, true), scene::diffuse(Rgb(0.5f), Rgb(1)));
  const auto d = lab.document(std::move(scene), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  lab.expect_near("path-pure", "", lab.mean(Lab::with_method(d, "path-pure"), 64).value, 2, 5e-3);
  lab.expect_between("path", "", lab.mean(Lab::with_method(d, "path"), 64).value, 2.05, 4);
}

inline constexpr Case kCoincidentLights{
    "coincident-lights", Kind::geometry,
    "Two lights in the same place count once for a walk, which meets the nearer, and twice for connections, which "
    "reach both: methods disagree by up to a factor two",
    coincident_lights};

}  // namespace etendue::stress
