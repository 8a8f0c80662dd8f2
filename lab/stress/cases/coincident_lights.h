// An emitting closed box whose walls exist twice.   [Lang, sec. 9.1.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void coincident_lights(TestContext& test) {
  scene::Scene scene = scene::furnace(0.5f);
  scene::add(scene, scene::cube(1, true), scene::diffuse(Rgb(0.5f), Rgb(1)));
  const auto d = test.document(std::move(scene), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  test.expect_near("path-pure", "", test.mean(TestContext::with_method(d, "path-pure"), 64).value, 2, 5e-3);
  test.expect_between("path", "", test.mean(TestContext::with_method(d, "path"), 64).value, 2.05, 4);
}

inline constexpr Case kCoincidentLights{
    .name = "coincident-lights",
    .kind = Kind::geometry,
    .theory =
        "Of two coincident emitters a traced ray finds only the nearer one, while light sampling "
        "reaches both, so the methods differ by up to a factor of two",
    .run = coincident_lights};

}  // namespace etendue::stress
