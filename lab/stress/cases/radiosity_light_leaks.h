// A thin wall across the patches of a floor: the dark side of a room divided by the wall.   [Lang, sec. 10.1.3]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void radiosity_light_leaks(TestContext& test) {
  // A box whose wall at x = 0.37 keeps the light of one half away from the other.
  scene::Scene scene;
  scene::add(scene, scene::cube(1, true), scene::diffuse(Rgb(0.5f)));
  scene::add(scene, scene::rectangle({0.37f, -1, -1}, {0, 2, 0}, {0, 0, 2}), scene::diffuse(Rgb(0.5f)));
  scene::add_point_light(scene, {-0.4f, 0, 0}, 1);
  const auto d = test.document(scene, narrow_camera({0.8f, 0.5f, 0.1f}, {0.43f, -1, 0.1f}));
  auto bright = d;
  bright.camera = narrow_camera({-0.6f, 0.5f, 0.1f}, {-0.3f, -1, 0.1f});
  const auto leak = [&](const std::string& settings) {
    const std::string method = "radiosity:" + settings;
    return test.mean(TestContext::with_method(d, method), 4).value /
           test.mean(TestContext::with_method(bright, method), 4).value;
  };
  test.expect_between("radiosity:patches=60", "light behind the wall over light before it", leak("patches=60:rays=64"),
                      0.02, 1);
  test.expect_between("radiosity:patches=6000", "light behind the wall over light before it",
                      leak("patches=6000:rays=16:light-samples=4"), 0, 0.01);
  const double path = test.mean(TestContext::with_method(d, "path"), 16).value;
  test.expect_zero("path", "light behind the wall", path);
}

inline constexpr Case kRadiosityLightLeaks{.name = "radiosity-light-leaks",
                                           .kind = Kind::bias,
                                           .theory =
                                               "A patch that a wall crosses has one irradiance for both sides of the "
                                               "wall, so light leaks into the dark by the "
                                               "size of a patch; smaller patches shrink the leak",
                                           .run = radiosity_light_leaks};

}  // namespace etendue::stress
