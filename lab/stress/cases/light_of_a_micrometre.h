// A disk light of constant intensity with a radius down to 1 micrometre.   [Shirley et al. 1996]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void light_of_a_micrometre(TestContext& test) {
  for (const float radius : {1e-2f, 1e-4f, 1e-6f}) {
    scene::Scene scene;
    scene::add(scene, scene::quad(10), scene::diffuse(Rgb(0.5f)));
    Material light = scene::diffuse(Rgb(0), Rgb(1 / (kPi * radius * radius)));
    light.double_sided = false;
    Mat4 transform(1);
    transform[1][1] = -1;
    transform[2][2] = -1;
    transform[3] = Vec4(0, 1, 0, 1);
    scene::add(scene, scene::disk(radius, 16), light, transform);
    const auto d = test.document(std::move(scene), narrow_camera({3, 0.8f, 0}, {0, 0, 0}));
    test.expect_near("path", "radius " + number(radius), test.mean(TestContext::with_method(d, "path"), 16).value,
                     0.5 / kPi, 2e-3);
  }
}

inline constexpr Case kLightOfAMicrometre{
    .name = "light-of-a-micrometre",
    .kind = Kind::parameters,
    .theory =
        "An area light of constant power that shrinks converges to a point light, and light sampling "
        "keeps its variance",
    .run = light_of_a_micrometre};

}  // namespace etendue::stress
