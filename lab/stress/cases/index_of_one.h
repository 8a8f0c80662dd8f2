// A ball of index one under a uniform sky.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void index_of_one(Lab& lab) {
  scene::Scene scene = sky();
  scene::add(scene, scene::sphere(1, 48, false), scene::glass(1));
  const auto d = lab.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f));
  for (const auto& method : unbiased_methods()) {
    // Light paths that choose their pixels leave noise even in a uniform sky.
    const film::Mean mean = lab.mean(Lab::with_method(d, method), 16);
    lab.expect_near(method, "", mean.value, 1, 1e-5 + 4 * mean.standard_error);
  }
}

inline constexpr Case kIndexOfOne{
    "index-of-one", Kind::parameters,
    "Glass with the index of its surroundings neither reflects nor bends: in a uniform sky it cannot be seen",
    index_of_one};

}  // namespace etendue::stress
