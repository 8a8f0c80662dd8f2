// A lens of zero radius, and a lens focused at infinity.   [Lang, sec. 8.4.3.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void lens_of_no_size(TestContext& test) {
  scene::Scene scene = uniform_sky();
  scene::add(scene, scene::sphere(1, 24, false), scene::diffuse(Rgb(0)));
  const auto pinhole = test.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 1));
  const auto with_lens = [&](float radius, float focus) {
    auto d = pinhole;
    d.camera.lens_radius = radius;
    d.camera.focus_distance = focus;
    return test.mean(d, 256).value;
  };
  const double sharp = test.mean(pinhole, 256).value;
  for (const float focus : {1e-6f, 1.0f, 1e9f})
    test.expect_near("path", "no aperture, focus at " + number(focus), with_lens(0, focus), sharp, 0);
  for (const float radius : {1e-30f, 1e-9f})
    test.expect_near("path", "aperture " + number(radius), with_lens(radius, 4), sharp, 1e-3);
  // The rays of a pixel become parallel: the rim of the sphere is blurred by the width of the lens, with the same mean.
  for (const float focus : {1e6f, 1e9f})
    test.expect_near("path", "aperture 0.1, focus at " + number(focus), with_lens(0.1f, focus), sharp, 1e-2);
}

inline constexpr Case kLensOfNoSize{
    .name = "lens-of-no-size",
    .kind = Kind::parameters,
    .theory =
        "An aperture of zero is a pinhole for any focus distance, and a focus at infinity sends "
        "parallel rays through the lens",
    .run = lens_of_no_size};

}  // namespace etendue::stress
