// A point light above a glass sphere above a disk that lies completely in the shadow of the sphere. All light arrives
// on paths ESDL, read from the camera, from a light without extent.   [Lang, sec. 9.1.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void caustic_of_a_point_light(TestContext& test) {
  scene::Scene scene;
  scene::add(scene, scene::disk(0.2f, 64), scene::diffuse(Rgb(0.8f)));
  Mat4 transform(1);
  transform[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::sphere(0.5f, 48, false), scene::glass(), transform);
  add_point_light(scene, {0, 3, 0}, 10);
  const auto d = test.document(std::move(scene), narrow_camera({1.5f, 0.3f, 0}, {0, 0, 0}));
  for (const auto& method : unbiased_integrators())
    test.expect_zero(method, "", test.mean(TestContext::with_method(d, method), 64).value);
}

inline constexpr Case kCausticOfAPointLight{
    .name = "caustic-of-a-point-light",
    .kind = Kind::missing_paths,
    .theory =
        "A path from the camera never hits a point, and the connection to it is blocked by the glass, "
        "so the caustic is missing without any noise",
    .run = caustic_of_a_point_light};

}  // namespace etendue::stress
