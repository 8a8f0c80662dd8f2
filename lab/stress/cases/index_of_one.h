// A sphere with index of refraction one under a uniform sky.   [Lang, sec. 4.2.1.3]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void index_of_one(TestContext& test) {
  scene::Scene scene = uniform_sky();
  scene::add(scene, scene::sphere(1, 48, false), scene::glass(1));
  const auto d = test.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f));
  for (const auto& method : unbiased_integrators()) {
    // Methods that splat onto pixels have noise even in a uniform sky.
    const film::Mean mean = test.mean(TestContext::with_method(d, method), 16);
    test.expect_near(method, "", mean.value, 1, 1e-5 + 4 * mean.standard_error);
  }
}

inline constexpr Case kIndexOfOne{
    .name = "index-of-one",
    .kind = Kind::parameters,
    .theory = "Glass with the index of its surroundings neither reflects nor refracts, so it is invisible",
    .run = index_of_one};

}  // namespace etendue::stress
