// A furnace far from the origin.   [IEEE 754]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void far_from_the_origin(TestContext& test) {
  for (const float far : {0.0f, 1e2f, 1e4f}) {
    scene::Scene scene;
    Mat4 transform(1);
    transform[3] = Vec4(far, -far, far, 1);
    scene::add(scene, scene::cube(1, true), scene::diffuse(Rgb(0.5f), Rgb(1)), transform);
    const Vec3 middle(far, -far, far);
    const auto d = test.document(std::move(scene), look_at(middle, middle + Vec3(0, 0, 1), {0, 1, 0}, 1));
    for (const auto& method : unbiased_integrators())
      test.expect_near(method, "at " + number(far) + " m", test.mean(TestContext::with_method(d, method), 64).value, 2,
                       0.01);
  }
}

inline constexpr Case kFarFromTheOrigin{
    .name = "far-from-the-origin",
    .kind = Kind::geometry,
    .theory =
        "A room of 2 m keeps its radiance where coordinates resolve a millimetre only, because "
        "offsets of ray origins grow with the coordinates and prevent leaks",
    .run = far_from_the_origin};

}  // namespace etendue::stress
