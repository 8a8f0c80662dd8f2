// A lens that is a point, and a lens that is focused on what is farthest.                              digest 8-10: F29
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void lens_of_no_size(Lab& lab) {
  scene::Scene scene = sky();
  scene::add(scene, scene::sphere(1, 24, false), scene::diffuse(Rgb(0)));
  const auto pinhole = lab.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 1));
  const auto with_lens = [&](float radius, float focus) {
    auto d = pinhole;
    d.camera.lens_radius = radius, d.camera.focus_distance = focus;
    return lab.mean(d, 256).value;
  };
  const double sharp = lab.mean(pinhole, 256).value;
  for (const float focus : {1e-6f, 1.0f, 1e9f})
    lab.expect_near("path", "no aperture, focus at " + number(focus), with_lens(0, focus), sharp, 0);
  for (const float radius : {1e-30f, 1e-9f})
    lab.expect_near("path", "aperture " + number(radius), with_lens(radius, 4), sharp, 1e-3);
  // Far away all rays of a pixel are parallel: the ball's rim is as blurred as the lens is wide, its light the same.
  for (const float focus : {1e6f, 1e9f})
    lab.expect_near("path", "aperture 0.1, focus at " + number(focus), with_lens(0.1f, focus), sharp, 1e-2);
}

inline constexpr Case kLensOfNoSize{"lens-of-no-size", Kind::parameters,
                                    "An aperture of zero is a pinhole wherever it is focused, and a focus at infinity "
                                    "sends parallel rays through the lens",
                                    lens_of_no_size};

}  // namespace etendue::stress
