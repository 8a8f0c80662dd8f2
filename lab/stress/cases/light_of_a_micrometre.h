// A disk light of constant intensity, down to a radius of a millionth of a metre.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void light_of_a_micrometre(Lab& lab) {
  for (const float radius : {1e-2f, 1e-4f, 1e-6f}) {
    scene::Scene scene;
    scene::add(scene, scene::quad(10), scene::diffuse(Rgb(0.5f)));
    Material light = scene::diffuse(Rgb(0), Rgb(1 / (kPi * radius * radius)));
    light.double_sided = false;
    Mat4 place(1);
    place[1][1] = -1, place[2][2] = -1, place[3] = Vec4(0, 1, 0, 1);
    scene::add(scene, scene::disk(radius, 16), light, place);
    const auto d = lab.document(std::move(scene), telescope({3, 0.8f, 0}, {0, 0, 0}));
    lab.expect_near("path", "radius " + number(radius), lab.mean(Lab::with_method(d, "path"), 16).value, 0.5 / kPi,
                    2e-3);
  }
}

inline constexpr Case kLightOfAMicrometre{
    "light-of-a-micrometre", Kind::parameters,
    "A light of constant power that shrinks becomes a point light: connections do not notice", light_of_a_micrometre};

}  // namespace etendue::stress
