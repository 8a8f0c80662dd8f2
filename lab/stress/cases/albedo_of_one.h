// A white ball and a white pit under a uniform sky.                                                    digest 8-10: F14
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void albedo_of_one(Lab& lab) {
  scene::Scene scene = sky();
  scene::add(scene, scene::sphere(1, 48, false), scene::diffuse(Rgb(1)));
  Mat4 place(1);
  place[3] = Vec4(0, -1, 0, 1);
  scene::add(scene, scene::quad(2), scene::diffuse(Rgb(1)), place);
  const auto d = lab.document(std::move(scene), look_at({0, 1, 4}, {0, -0.5f, 0}, {0, 1, 0}, 0.5f));
  for (const auto& method : unbiased_methods())
    lab.expect_mean(method, "", lab.mean(Lab::with_method(d, method), 64), 1);
}

inline constexpr Case kAlbedoOfOne{
    "albedo-of-one", Kind::parameters,
    "A surface that absorbs nothing under a uniform sky has the sky's radiance, and walks on it end", albedo_of_one};

}  // namespace etendue::stress
