// A point light at the centre of a hollow diffuse sphere.   [Appel 1968; Whitted 1980]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void integrating_sphere(TestContext& test) {
  constexpr double kAlbedo = 0.8;
  scene::Scene scene;
  scene::add(scene, scene::sphere(2, 64, true), scene::diffuse(Rgb(static_cast<float>(kAlbedo))));
  add_point_light(scene, {0, 0, 0}, 5);
  const auto d = test.document(std::move(scene), look_at({0, 0, 0.5f}, {0, 0.2f, 2}, {0, 1, 0}, 0.8f));
  const double direct = kAlbedo / kPi * 5 / 4, total = direct / (1 - kAlbedo);
  for (const char* method : {"appel", "whitted"}) {
    test.expect_near(method, "direct reflection", test.mean(TestContext::with_method(d, method), 16).value, direct,
                     4e-3);
    auto indirect = TestContext::with_method(d, method);
    indirect.method.paths = "E(D|G)(D|G|S)+L";
    test.expect_zero(method, "multiple reflections", test.mean(indirect, 16).value);
  }
  for (const char* method : {"path", "distribution"})
    test.expect_near(method, "all reflections", test.mean(TestContext::with_method(d, method), 64).value, total, 1e-2);
}

inline constexpr Case kIntegratingSphere{
    .name = "integrating-sphere",
    .kind = Kind::missing_paths,
    .theory =
        "Of the light reflected repeatedly by diffuse walls, classic ray tracing finds the first "
        "reflection, a fraction 1 - albedo, and none of the rest",
    .run = integrating_sphere};

}  // namespace etendue::stress
