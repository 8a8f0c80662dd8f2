// A point light over a glass ball over a disk that lies wholly in the ball's shadow: all light arrives as ESDL read
// from the camera, through a light without extent.                                                     digest 8-10: F31
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void caustic_of_a_point_light(Lab& lab) {
  scene::Scene scene;
  scene::add(scene, scene::disk(0.2f, 64), scene::diffuse(Rgb(0.8f)));
  Mat4 place(1);
  place[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::sphere(0.5f, 48, false), scene::glass(), place);
  add_point_light(scene, {0, 3, 0}, 10);
  const auto d = lab.document(std::move(scene), telescope({1.5f, 0.3f, 0}, {0, 0, 0}));
  for (const auto& method : unbiased_methods())
    lab.expect_zero(method, "", lab.mean(Lab::with_method(d, method), 64).value);
}

inline constexpr Case kCausticOfAPointLight{"caustic-of-a-point-light", Kind::missing_paths,
                                            "No walk from the camera can end on a point, and a connection to it is "
                                            "blocked by the glass: the caustic is missing "
                                            "without a trace of noise",
                                            caustic_of_a_point_light};

}  // namespace etendue::stress
