// A white metal under a uniform sky, from a mirror to the roughest.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void roughness_at_its_ends(Lab& lab) {
  double before = 1 + 1e-3;
  for (const float roughness : {0.0f, 0.01f, 0.3f, 0.7f, 1.0f}) {
    scene::Scene scene = sky();
    Material metal;
    metal.metallic = 1, metal.roughness = roughness;
    scene::add(scene, scene::sphere(1, 64, false), metal);
    const auto d = lab.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.2f));
    const double mean = lab.mean(Lab::with_method(d, "path"), 64).value;
    lab.expect_between("path", "roughness " + number(roughness), mean, 0.3, before);
    before = mean + 1e-3;
  }
}

inline constexpr Case kRoughnessAtItsEnds{
    "roughness-at-its-ends", Kind::parameters,
    "A white metal under a uniform sky: a mirror loses nothing, and what a single bounce between facets leaves falls "
    "with roughness, never rises above one",
    roughness_at_its_ends};

}  // namespace etendue::stress
