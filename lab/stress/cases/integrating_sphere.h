// A lamp in the middle of a hollow white ball.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void integrating_sphere(Lab& lab) {
  constexpr double kAlbedo = 0.8;
  scene::Scene scene;
  scene::add(scene, scene::sphere(2, 64, true), scene::diffuse(Rgb(static_cast<float>(kAlbedo))));
  add_point_light(scene, {0, 0, 0}, 5);
  const auto d = lab.document(std::move(scene), look_at({0, 0, 0.5f}, {0, 0.2f, 2}, {0, 1, 0}, 0.8f));
  const double direct = kAlbedo / kPi * 5 / 4, whole = direct / (1 - kAlbedo);
  for (const char* method : {"appel", "whitted"}) {
    lab.expect_near(method, "what is found", lab.mean(Lab::with_method(d, method), 16).value, direct, 4e-3);
    auto indirect = Lab::with_method(d, method);
    indirect.method.paths = "E(D|G)(D|G|S)+L";
    lab.expect_zero(method, "by more than one surface", lab.mean(indirect, 16).value);
  }
  for (const char* method : {"path", "distribution"})
    lab.expect_near(method, "all of it", lab.mean(Lab::with_method(d, method), 64).value, whole, 1e-2);
}

inline constexpr Case kIntegratingSphere{
    "integrating-sphere", Kind::missing_paths,
    "Of light that is sent on and on between white walls, classic ray tracing finds the first reflection: 1 - albedo "
    "of it, and of the rest exactly nothing",
    integrating_sphere};

}  // namespace etendue::stress
