// A white metal under a uniform sky, from a mirror to the largest roughness.   [Heitz 2014]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void roughness_at_its_ends(TestContext& test) {
  double previous = 1 + 1e-3;
  for (const float roughness : {0.0f, 0.01f, 0.3f, 0.7f, 1.0f}) {
    scene::Scene scene = uniform_sky();
    Material metal;
    metal.metallic = 1;
    metal.roughness = roughness;
    scene::add(scene, scene::sphere(1, 64, false), metal);
    const auto d = test.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.2f));
    const double mean = test.mean(TestContext::with_method(d, "path"), 64).value;
    test.expect_between("path", "roughness " + number(roughness), mean, 0.3, previous);
    previous = mean + 1e-3;
  }
}

inline constexpr Case kRoughnessAtItsEnds{
    .name = "roughness-at-its-ends",
    .kind = Kind::parameters,
    .theory =
        "A mirror loses nothing, and the energy that single scattering between microfacets keeps "
        "decreases with roughness and never exceeds one",
    .run = roughness_at_its_ends};

}  // namespace etendue::stress
